# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What the page tells of values of which several are right, and of the error that a profile accepts."""
import unittest

from page_support import PageTest

# Beside a Sample input a fragment may be shaded once a sample: FragCoord.xy is then the sample.
SHADED = """format = 1
description = "A square with an input at the sample."
rules = ["interp.sample"]
[target]
size = [8, 8]
samples = 4
[[draw]]
vertices = [[1,1], [7,1], [1,7],  [7,1], [7,7], [1,7]]
[[draw.attribute]]
plane = ["x", "y"]
auxiliary = "sample"
"""


class ToldValues(PageTest):
    cases = {"told/shaded": SHADED}
    fault = "flip-pixel@told/shaded"
    accepted = {"direct3d": "2 are accepted", "vulkan": "1342 are accepted"}

    @classmethod
    def make_run(cls):
        for profile in cls.accepted:
            cls.edgecase("run", "--renderer=reference", "--profile", profile, "-o", cls.folder / profile, check=1, fault=cls.fault)
        cls.out = cls.folder / "direct3d"

    def test_other_numbers_that_are_right(self):
        for profile, others in (("direct3d", 1), ("vulkan", 4)):
            page = self.open("#case=told%2Fshaded", file=self.folder / profile / "report.html")
            rows = page.run("[...document.querySelectorAll('.values tbody')].map((r) => r.innerText)")
            told = [r for r in rows if r.startswith("frag_coord.x")]
            self.assertEqual(len(told), 1, rows)
            self.assertRegex(told[0], r"or [\d.]+(, [\d.]+){%d}, bit for bit" % (others - 1))
            self.assertFalse([r for r in rows if r.startswith("attribute") and "bit for bit" in r])

    def test_nan_and_infinity_have_one_name(self):
        told = self.open(file=self.out / "report.html").run(
            "['7fc00000', 'ffc00001', '7f800000', 'ff800000'].map((bits) => valueRow(['depth', '', '0.5', '1e-7', '0', '1', parseInt(bits, 16)],"
            "[{quantity: 'depth'}], true, true).innerText)")
        for row, name in zip(told, ("NaN", "NaN", "infinity", "\u2212infinity")):
            self.assertEqual(row.split("0x")[0].split("]")[1], name, row)
            for other in ("no number", "another number" if name == "NaN" else "nan", "inf budgets", "\u221e"):
                self.assertNotIn(other, row)
        page = self.open(file=self.out / "report.html")
        self.assertEqual(page.run("[errorText(255), shortNumber('inf'), shortNumber('-inf'), shortNumber('nan')]"), ["NaN or infinity", "infinity", "\u2212infinity", "NaN"])

    def test_the_accepted_error_is_the_profiles(self):
        for profile, text in self.accepted.items():
            page = self.open("#case=told%2Fshaded&view=error", file=self.folder / profile / "report.html")
            self.assertIn("; " + text, page.run("document.body.innerText"))


if __name__ == "__main__":
    unittest.main()
