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
