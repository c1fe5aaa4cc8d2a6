# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The driver of the browser: waiting goes on while pages lead to others."""
import pathlib
import shutil
import tempfile
import unittest

import devtools

HOPS = 60
# Each page is left for the next as soon as it stands, the last one stays.
HOPPING = f"""<!doctype html><title>hopping</title><script>
const at = Number(location.search.slice(1));
if (at < {HOPS}) setTimeout(() => location.replace("?" + (at + 1)), 0);
</script>"""


class Answers:
    """In the browser's place: gives the answers that it was given, in turn."""

    def __init__(self, *answers):
        self.answers = list(answers)

    def send(self, method, _parameters, _session):
        answer = self.answers.pop(0)
        if isinstance(answer, Exception):
            raise answer
        return {"result": {"value": answer}}


class Refusals(unittest.TestCase):
    def page(self, *answers):
        page = devtools.Page.__new__(devtools.Page)
        page.browser, page.session = Answers(*answers), "session"
        return page

    def test_a_page_that_is_left_is_asked_again(self):
        for text in devtools.BETWEEN_PAGES:
            page = self.page(False, devtools.Refused(f"Runtime.evaluate: {text}."), False, True)
            page.wait_for("true")
            self.assertEqual(page.browser.answers, [])

    def test_other_refusals_are_told(self):
        for error in (devtools.Refused("Runtime.evaluate: Session with given id not found."), RuntimeError("the browser has ended"),
                      TimeoutError("the browser does not answer")):
            with self.assertRaises(type(error)):
                self.page(error, True).wait_for("true")


@unittest.skipIf(devtools.find_chromium() is None, "there is no Chromium")
class Waiting(unittest.TestCase):
    def setUp(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="edgecase-page-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        self.file = folder / "hopping.html"
        self.file.write_text(HOPPING, encoding="utf-8")
        browser = devtools.Browser(devtools.find_chromium())
        self.addCleanup(browser.close)
        self.page = devtools.Page(browser)

    def test_goes_on_while_pages_are_left(self):
        self.page.send("Page.navigate", {"url": self.file.as_uri() + "?0"})
        self.page.wait_for(f"location.search === '?{HOPS}'")
        self.assertEqual(self.page.run("location.search"), f"?{HOPS}")

    def test_a_wrong_expression_is_told(self):
        self.page.open(self.file, f"?{HOPS}")
        with self.assertRaisesRegex(AssertionError, "no such thing"):
            self.page.wait_for("(() => { throw new Error('no such thing'); })()")


if __name__ == "__main__":
    unittest.main()
