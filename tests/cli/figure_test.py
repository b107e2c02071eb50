"""The figure for browsers, in headless Chromium: figure_test.py PROGRAM [unittest's arguments]."""

import html
import json
import re
import shutil
import subprocess
import unittest

import numpy as np

from program_case import ProgramCase, plane

BROWSER = shutil.which("chromium") or "chromium"
SHIFT, TURN = np.array([0.1, 0.02, -0.05]), np.array([0.1, -0.2, 0.3])
ACCURACY = 1e-5  # relative: numbers in the figure are of single precision


def scene(method, translate, turn=(0, 0, 0), centre=(0, 0, 0)):
    """A cube, its left face fixed, its right face shifted and turned (linearly) about a centre."""
    a, b, c = turn
    matrix = np.array([[0, -c, b], [c, 0, -a], [-b, a, 0]], float)
    handle = {"name": "right", "select": plane(1), "matrix": matrix.tolist(),
              "translate": (np.array(translate) - matrix @ centre).tolist()}
    return {"elastolab": 1, "mesh": {"primitive": "cube", "resolution": 3}, "method": method, "fixed": plane(0),
            "material": {"young_modulus": 1000.0, "poisson_ratio": 0.3}, "handles": [handle]}


class Figure(ProgramCase):
    def run_in_browser(self, script):
        """What a script, which sees the page when it is shown, puts into `result`."""
        page = (self.folder / "figure.html").read_text(encoding="utf-8")
        end = f"<pre id=result></pre><script>{{const result = {{}};{script};document.getElementById('result').textContent = " \
              "JSON.stringify(result)}</script></body>"
        (self.folder / "page.html").write_text(page.replace("</body>", end), encoding="utf-8")
        run = subprocess.run(
            [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             f"--user-data-dir={self.folder / 'profile'}", "--window-size=900,700", "--virtual-time-budget=4000", "--dump-dom",
             (self.folder / "page.html").as_uri()],
            capture_output=True, text=True, timeout=120, check=True)
        error = re.search(r'<div id="error"[^>]*>(.*?)</div>', run.stdout, re.S)
        self.assertEqual(error.group(1), "")
        return json.loads(html.unescape(re.search(r'<pre id="result">(.*?)</pre>', run.stdout, re.S).group(1)))

    def test_a_pulled_figure_is_what_solve_says(self):
        for method in ("galerkin-bem", "quadratic-fem"):
            self.solve(scene(method, [0.05, 0, 0]), "--figure", "figure.html")
            shown = self.run_in_browser(
                f"figure.handles[0].p.set({[*SHIFT, *TURN]}); figure.update();"
                "result.u = Array.from(figure.displacement()); result.s = figure.vonMises();"
                "result.centre = figure.handles[0].centre")
            np.testing.assert_allclose(shown["centre"], [1, 0.5, 0.5], atol=1e-12)
            self.solve(scene(method, SHIFT + [0.05, 0, 0], TURN, [1, 0.5, 0.5]), "--fields", "f.csv")
            u = self.columns("f.csv", "displacement_x", "displacement_z")
            np.testing.assert_allclose(np.reshape(shown["u"], (-1, 3)), u, atol=ACCURACY * abs(u).max())
            von_mises = self.columns("f.csv", "von_mises", "von_mises")[:, 0]
            np.testing.assert_allclose(shown["s"], von_mises, atol=ACCURACY * von_mises.max())

    def test_a_pointer_pulls_a_handle_and_looks_around(self):
        self.solve(scene("linear-bem", [0, 0, 0]), "--figure", "figure.html")
        shown = self.run_in_browser(
            "const view = document.getElementById('view'), h = figure.handles[0], v = h.vertices[5];"
            "const act = (kind, x, y, more = {}) => view.dispatchEvent(new PointerEvent(kind,"
            "  {pointerId: 1, clientX: x, clientY: y, bubbles: true, ...more}));"
            "let [x, y] = figure.onScreen(v);"
            "act('pointerdown', x, y); act('pointermove', x + 20, y - 10); act('pointerup', x + 20, y - 10);"
            "result.moved = figure.onScreen(v).map((a, i) => a - [x, y][i]); result.p = Array.from(h.p);"
            "[x, y] = figure.onScreen(v);"
            "act('pointerdown', x, y); act('pointermove', x + 20, y, {shiftKey: true}); act('pointerup', x + 20, y);"
            "result.turned = Array.from(h.p);"
            "act('pointerdown', 2, 2); act('pointermove', 40, 2); act('pointerup', 40, 2);"
            "result.looked = Array.from(h.p); document.getElementById('reset').click(); result.reset = Array.from(h.p);"
            "result.largest = Math.max(...figure.displacement())")
        np.testing.assert_allclose(shown["moved"], [20, -10], atol=1e-3)
        self.assertEqual(shown["p"][3:], [0, 0, 0])
        self.assertEqual(shown["turned"][:3], shown["p"][:3])
        self.assertAlmostEqual(float(np.linalg.norm(shown["turned"][3:])), 0.2, 9)
        self.assertEqual(shown["looked"], shown["turned"])
        self.assertEqual(shown["reset"], [0] * 6)
        self.assertEqual(shown["largest"], 0)

    def test_the_axis_of_the_scene_points_up_and_a_body_may_be_far_away(self):
        for axis, vertical in enumerate(np.eye(3)):
            description = scene("linear-bem", [0.1, 0, 0])
            description["camera"] = {"eye": [5, 4, 3], "target": [0.5, 0.5, 0.5], "up": vertical.tolist(),
                                     "vertical": vertical.tolist()}
            self.solve(description, "--figure", "figure.html", "--displacements", "u.csv")
            rest = self.columns("u.csv", "x", "z")
            shown = self.run_in_browser("figure.displacement().fill(0);"
                                        f"result.at = Array.from({{length: {len(rest)}}}, (_, v) => figure.onScreen(v))")
            height = -np.array(shown["at"])[:, 1]
            along = [np.corrcoef(height, rest[:, k])[0, 1] for k in range(3)]
            self.assertEqual(int(np.argmax(along)), axis)
            self.assertGreater(along[axis], 0.6)

    def test_a_figure_names_no_other_file_and_survives_any_name(self):
        description = scene("linear-bem", [0.1, 0, 0])
        description["handles"][0]["name"] = "</script><b>\u00fc"
        self.solve(description, "--figure", "figure.html")
        page = (self.folder / "figure.html").read_text(encoding="utf-8")
        self.assertIsNone(re.search(r"(src|href)\s*=|https?://|@import|fetch\(", page))
        self.assertEqual(self.run_in_browser("result.name = figure.handles[0].name")["name"], "</script><b>\u00fc")


if __name__ == "__main__":
    unittest.main()
