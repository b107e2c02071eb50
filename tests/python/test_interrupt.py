"""Ctrl-C in a process of its own."""

import signal
import subprocess
import sys
import time

import pytest

WORK = """
import elastolab as el, sys, time
body = el.Surface.primitive("cube", 30)
def progress(stage, fraction):
    if not told and fraction > 0.0:
        told.append(1)
        print("computing", flush=True)
told = []
try:
    el.precompute(body, method={method!r}, mode={mode!r}, progress=progress)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.parametrize(("method", "mode"), [("linear-bem", "full"), ("galerkin-bem", "full")])
def test_ctrl_c_ends_a_precomputation(method, mode):
    code = WORK.format(method=method, mode=mode)
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "computing\n"
        process.send_signal(signal.SIGINT)
        begin = time.monotonic()
        assert process.stdout.readline() == "interrupted\n"
        print(f"{method}: {time.monotonic() - begin:.3f} s")
        assert process.wait() == 0


# Threads that compute when the interpreter ends: daemons, and those whose join was interrupted.
BEGIN = """
import elastolab as el, os, signal, sys, threading, time
body = el.Surface.primitive("cube", 18)
begun = threading.Event()
def compute():
    el.precompute(body, method="galerkin-bem", progress=lambda stage, fraction: begun.set())
def frames():
    model = el.precompute(el.Surface.primitive("cube", 6), method="fem")
    deformer = model.constrain(fixed=range(9), handles=range(20, 24))
    while True:
        deformer.displace([0.1, 0.0, 0.0])
        begun.set()
"""
ENDS = {
    "a daemon that precomputes": "threading.Thread(target=compute, daemon=True).start(); begun.wait()",
    "daemons that draw frames": "[threading.Thread(target=frames, daemon=True).start() for _ in range(3)]; begun.wait()",
    "an interrupted join": """
thread = threading.Thread(target=compute)
thread.start()
begun.wait()
threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    thread.join()
except KeyboardInterrupt:
    sys.exit(0)
""",
}


@pytest.mark.parametrize("end", ENDS)
def test_the_interpreter_ends_while_threads_compute(end):
    run = subprocess.run([sys.executable, "-c", BEGIN + ENDS[end]], capture_output=True, text=True, timeout=60)
    assert (run.returncode, run.stderr) == (0, "")
