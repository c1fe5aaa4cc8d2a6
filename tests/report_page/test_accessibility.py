# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""The pages break no rule of accessibility.py, in either scheme, wide and narrow; every rule finds what it is for."""
import unittest

from accessibility import problems
from page_support import CASES, PageTest

# One error each: what is done to the page, and the rule that has to say so.
PLANTED = {
    "document.documentElement.lang = ''": "lang",
    "document.title = ''": "title",
    "byId('help-button').textContent = ''; byId('help-button').title = ''": "name",
    "byId('filter').labels[0].replaceWith(byId('filter'))": "name",
    "document.querySelector('.frame canvas').removeAttribute('aria-label')": "picture",
    "document.querySelector('.legend canvas').removeAttribute('aria-hidden')": "picture",
    "byId('theme').tabIndex = 3": "tabindex",
    "byId('theme').id = 'help-button'": "id",
    "document.querySelector('.case-page').setAttribute('aria-labelledby', 'nothing')": "reference",
    "document.querySelector('.findings h2').outerHTML = '<h4>Findings</h4>'": "heading",
    "document.querySelector('.case-head h1').outerHTML = '<h2>Title</h2>'": "heading",
    "document.querySelector('.findings th').outerHTML = '<td>what</td>'": "table",
    "document.querySelector('.findings th').removeAttribute('scope')": "table",
    "document.querySelector('.findings tbody tr').append(document.createElement('td'))": "table",
    "document.querySelector('main').outerHTML = '<div>' + document.querySelector('main').innerHTML + '</div>'": "landmark",
    "document.body.append('text', Object.assign(document.createElement('p'), {textContent: 'more'}))": "landmark",
    "(() => { const e = document.querySelector('.rules-scroll, .case-head'); e.style.cssText = 'overflow: auto; height: 5px'; e.querySelectorAll('button').forEach((b) => b.remove()); })()": "scroll",
    "document.querySelector('.described').style.color = '#aaaaaa'": "contrast",
    "document.querySelector('.described').style.opacity = '.4'": "contrast",
    "document.querySelector('.case-page').style.background = '#777777'": "contrast",
    "byId('theme').style.outline = 'none'": "focus",
}


class Accessibility(PageTest):
    cases = CASES
    places = ("", "#q=four&group=rule", "#hide=fail", "#case=family%2Fwrong", "#case=family%2Fgood", "#case=texels%2Fblit", "#case=samples%2Ffour&view=side",
              "#case=family%2Fwrong&view=error")

    @classmethod
    def make_run(cls):
        super().make_run()
        cls.other = cls.folder / "other"
        cls.edgecase("run", "--renderer=reference", "-o", cls.other, check=1, fault="flip-pixel@family/good")
        cls.compared = cls.folder / "compared.html"
        cls.edgecase("compare", cls.out, cls.other, "--html", cls.compared, check=1)

    def each_window(self):
        for dark in (False, True):
            for width in (360, 1400):
                yield {"dark": dark, "width": width}

    def test_the_report_breaks_no_rule(self):
        for window in self.each_window():
            for place in self.places:
                page = self.open(place, **window)
                page.key("Tab")
                page.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
                self.assertEqual(problems(page), [], (place, window))

    def test_the_help_breaks_no_rule(self):
        for file in (self.report, self.compared):
            page = self.open(file=file)
            page.key("?")
            self.assertTrue(page.run("byId('help').open"))
            self.assertEqual(problems(page), [])

    def test_the_comparison_breaks_no_rule(self):
        for window in self.each_window():
            page = self.open(file=self.compared, **window)
            page.key("n")
            self.assertEqual(page.count(".detail"), 1)
            self.assertEqual(problems(page), [], window)

    def test_each_rule_finds_a_planted_error(self):
        for error, rule in PLANTED.items():
            overview = "filter" in error
            page = self.open("" if overview else "#case=family%2Fwrong")
            page.key("Tab")
            self.assertEqual(problems(page), [])
            page.run(error)
            self.assertIn(rule, {problem.split(":")[0] for problem in problems(page)}, error)


if __name__ == "__main__":
    unittest.main()
