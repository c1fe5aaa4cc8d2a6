# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""report.html as a reader uses it: opened from a file in a browser, with mouse and keyboard."""
import base64
import json
import random
import re
import unittest

from page_support import SQUARE, PageTest

MOST_BYTES = 8 << 20  # of a page with 2,000 cases, 300 of them failing


class Overview(PageTest):
    def test_lists_cases_causes_and_totals(self):
        page = self.open()
        self.assertIn("3 of 4 unexpected", page.run("document.title"))
        self.assertEqual(page.text("#statuses [data-status=fail] .tally"), "3")
        self.assertEqual(page.text("#statuses [data-status=pass] .tally"), "1")
        self.assertIn("cover.outside", page.text("#causes"))
        self.assertEqual(page.count("#causes tr[data-cause]"), 2)  # one of two families
        self.assertIn("4 of 4 cases", page.text("#shown"))
        self.assertEqual(page.count("#list tr.case-row"), 4)
        self.assertEqual(page.run("document.querySelector('#list tr.case-row').dataset.case"), "family/wrong")

    def test_filters_by_words_status_and_cause(self):
        page = self.open()
        page.click("#filter")
        page.type("four samples")
        self.assertEqual(page.count("#list tr.case-row"), 1)
        self.assertIn("samples/four", page.text("#list"))
        self.assertEqual(page.run("location.hash"), "#q=four+samples")
        page.click("#clear")
        self.assertEqual(page.count("#list tr.case-row"), 4)
        page.click("#statuses [data-status=pass]")
        self.assertEqual(page.count("#list tr.case-row"), 3)
        self.assertEqual(page.run("document.querySelector('[data-status=pass]').getAttribute('aria-pressed')"), "false")
        page.click("#clear")
        page.run("[...document.querySelectorAll('#causes tr[data-cause]')].find((r) => r.innerText.includes('blit')).querySelector('button').click()")
        self.assertEqual(page.count("#list tr.case-row"), 1)
        self.assertIn("texels/blit", page.text("#list"))

    def test_every_status_has_room_beside_the_case(self):
        page = self.open()
        gaps = page.run("Object.fromEntries(STATUSES.map((status) => { entries[0].record.status = status; showList();"
                        "const [first, second] = document.querySelector('tr[data-case=\"' + entries[0].record.id + '\"]').cells;"
                        "return [status, second.firstChild.getBoundingClientRect().left - first.firstChild.getBoundingClientRect().right]; }))")
        self.assertEqual(len(gaps), 13)
        self.assertGreaterEqual(min(gaps.values()), 12, gaps)

    def test_a_flake_is_told_as_one(self):
        page = self.open()
        page.run("(() => { const {record} = entryOf.get('family/wrong'); record.status = 'flake'; record.attempts = 3; showList(); })()")
        self.assertIn("differs from run to run (3 attempts) \u00b7 1 double of 64 samples", page.text("tr[data-case='family/wrong']"))

    def test_groups_and_sorts(self):
        page = self.open()
        for group, expected in (("rule", "cover.shared-edge"), ("status", "fail"), ("cause", "as expected"), ("family", "samples")):
            page.run(f"(() => {{ const s = byId('group'); s.value = '{group}'; s.dispatchEvent(new Event('change')); }})()")
            names = page.run("[...document.querySelectorAll('button.group')].map((b) => b.innerText.trim().slice(1))")
            self.assertIn(expected, names, group)
        first = page.run("document.querySelector('button.group').getAttribute('aria-expanded')")
        page.click("button.group")
        self.assertNotEqual(page.run("document.querySelector('button.group').getAttribute('aria-expanded')"), first)

    def test_the_address_keeps_the_list(self):
        page = self.open("#q=square&group=status&hide=pass")
        self.assertEqual(page.run("byId('group').value"), "status")
        self.assertEqual(page.count("#list tr.case-row"), 2)

    def test_themes_follow_the_system_and_the_button(self):
        paper = "getComputedStyle(document.body).backgroundColor"
        dark = self.open(dark=True).run(paper)
        page = self.open(dark=False)
        light = page.run(paper)
        self.assertNotEqual(dark, light)
        page.click("#theme")
        self.assertEqual(page.run(paper), dark)
        page.key("t")
        self.assertEqual(page.run(paper), light)

    def test_help_opens_and_closes(self):
        page = self.open()
        page.key("?")
        self.assertTrue(page.run("byId('help').open"))
        page.key("Escape")
        self.assertFalse(page.run("byId('help').open"))


class CasePage(PageTest):
    def test_a_click_opens_it_at_the_wrong_sample(self):
        page = self.open()
        page.click("#list a[href$='family%2Fwrong']")
        page.wait_for("document.getElementById('case-title') !== null")
        self.assertEqual(page.text("#case-title"), "family/wrong")
        self.assertEqual(page.text(".mark-line strong"), "double: hit too often")
        self.assertEqual(page.run("document.activeElement.id"), "case-title")
        self.assertIn("cover.outside", page.text(".broken"))
        self.assertIn("a diagonal that is hit twice", page.text(".case-head"))
        self.assertEqual(page.count(".findings tbody tr"), 1)
        page.key("Escape")
        self.assertEqual(page.count("#list tr.case-row"), 4)

    def test_text_never_becomes_markup(self):
        page = self.open("#case=family%2Fgood")
        self.assertEqual(page.text(".described"), "A square of two triangles and <img src=x onerror=alert(1)> </script> &amp;.")
        self.assertEqual(page.run("document.images.length"), 0)

    def test_the_address_leads_to_a_pixel_a_view_and_a_zoom(self):
        page = self.open("#case=family%2Fwrong&px=2,5&view=reference&zoom=32")
        self.assertIn("Pixel (2, 5)", page.text("#sample-summary"))
        self.assertEqual(page.text(".zoom-text"), "32\u00d7")
        self.assertEqual(page.run("document.querySelector('[data-view=reference]').getAttribute('aria-pressed')"), "true")
        page.key("ArrowRight")
        self.assertEqual(page.run("location.hash"), "#case=family%2Fwrong&px=3,5&view=reference&zoom=32")
        page.run("location.hash = '#case=family%2Fgood'")
        page.wait_for("document.getElementById('case-title').innerText === 'family/good'")
        page.run("location.hash = '#'")
        page.wait_for("!document.getElementById('overview').hidden")

    def test_keys_move_zoom_and_switch(self):
        page = self.open("#case=family%2Fwrong&px=4,4&view=difference")
        for key, place in (("ArrowLeft", "(3, 4)"), ("ArrowUp", "(3, 3)"), ("ArrowRight", "(4, 3)"), ("ArrowDown", "(4, 4)")):
            page.key(key)
            self.assertIn(place, page.text("#sample-summary"))
            self.assertIn("Pixel " + place, page.text("#announcer"))
        before = page.run("page.viewer.zoomNow()")
        page.key("-")
        self.assertLess(page.run("page.viewer.zoomNow()"), before)
        for _ in range(20):
            page.key("+")
        self.assertEqual(page.run("page.viewer.zoomNow()"), 128)
        page.key("0")
        self.assertEqual(page.run("page.viewer.zoomNow()"), before)
        for key, view in (("1", "reference"), ("2", "device"), ("3", "difference"), ("4", "error"), ("5", "blink"), ("6", "side")):
            page.key(key)
            self.assertEqual(page.run("viewing.view"), view)
            self.assertEqual(page.count(".frame canvas"), 3 if view == "side" else 1)
        page.key("b")
        self.assertEqual(page.text("figcaption"), "reference")
        page.run("document.activeElement.blur()")
        page.key(" ")
        self.assertEqual(page.text("figcaption"), "device")

    def test_next_and_previous_walk_through_unexpected_cases(self):
        page = self.open("#case=family%2Fwrong")
        page.key("n")
        self.assertEqual(page.text("#case-title"), "samples/four")
        page.key("n")
        self.assertEqual(page.text("#case-title"), "texels/blit")
        page.key("p")
        self.assertEqual(page.text("#case-title"), "samples/four")
        page.click("[data-step=p]")
        self.assertEqual(page.text("#case-title"), "family/wrong")

    def test_j_and_k_walk_through_findings(self):
        page = self.open("#case=samples%2Ffour")
        self.assertEqual(page.count(".findings tbody tr"), 1)
        at = page.run("location.hash")
        page.key("ArrowLeft")
        self.assertNotEqual(page.run("location.hash"), at)
        for key in "jk":
            page.key("ArrowLeft")
            page.key(key)
            self.assertEqual(page.run("location.hash"), at)

    def test_what_is_painted_are_the_device_s_hits(self):
        page = self.open("#case=family%2Fwrong&view=reference&zoom=16&px=0,0")
        page.run("['outlines', 'samples', 'grid'].forEach(toggle)")
        inside = self.color(page, 3, 3)
        self.assertEqual(self.color(page, 4, 2), inside)
        self.assertNotEqual(self.color(page, 7, 7), inside)
        wrong = page.run("page.findings[0]")
        page.key("3")
        self.assertNotEqual(self.color(page, wrong["x"], wrong["y"]), self.color(page, 3, 3))
        page.key("2")
        self.assertNotEqual(self.color(page, wrong["x"], wrong["y"]), self.color(page, 3, 3))

    def color(self, page, x, y):
        """The colour of the picture near the lower left corner of a pixel."""
        return page.run("(() => { const zoom = page.viewer.zoomNow(), c = document.querySelector('.frame canvas'); "
                        f"return [...c.getContext('2d').getImageData(({x} + 1) * zoom + 2, ({y} + 2) * zoom - 2, 1, 1).data].join(); }})()")

    def test_triangles_lie_where_the_vertices_are(self):
        page = self.open("#case=family%2Fwrong&view=reference&zoom=16&px=0,0")
        with_outlines = self.column(page, 1)
        page.key("o")
        self.assertNotEqual(with_outlines, self.column(page, 1), "the left edge at x = 1 is not drawn")
        page.key("o")
        self.assertEqual(with_outlines, self.column(page, 1))

    def column(self, page, x):
        return page.run("(() => { const zoom = page.viewer.zoomNow(), c = document.querySelector('.frame canvas'); "
                        f"return [...c.getContext('2d').getImageData(({x} + 1) * zoom, 5 * zoom + 5, 1, 1).data].join(); }})()")

    def test_tables_for_a_screen_reader(self):
        page = self.open("#case=family%2Fwrong")
        label = page.run("document.querySelector('.frame canvas').getAttribute('aria-label')")
        self.assertIn("8 by 8 pixels", label)
        self.assertIn("1 double", label)
        tree = page.send("Accessibility.getFullAXTree")["nodes"]
        roles = {node.get("role", {}).get("value") for node in tree}
        self.assertLessEqual({"main", "heading", "table", "columnheader", "image", "toolbar", "complementary"}, roles)
        unnamed = [n for n in tree if n.get("role", {}).get("value") == "button" and not n.get("name", {}).get("value")]
        self.assertEqual(unnamed, [])


class Samples(PageTest):
    def test_pointing_tells_edges_as_fractions(self):
        page = self.open("#case=family%2Fwrong&view=difference")
        page.move_to(*self.at(page, 2, 5))
        self.assertIn("Pixel (2, 5) at (2.5, 5.5)", page.text("#sample-summary"))
        # The diagonal is left edge of the second triangle; E from (7,1) to (1,7) vanishes on it.
        text = page.text(".triangles")
        self.assertIn("exactly on a right edge: the top-left rule gives it to the neighbour", text)
        self.assertIn("exactly on a left edge: the top-left rule gives it to this triangle", text)
        self.assertIn("= 0, a tie", text)
        page.move_to(*self.at(page, 2, 2))
        self.assertIn("9", page.text(".triangles"))

    def test_edges_are_those_that_explain_tells(self):
        for x, y in ((2, 5), (3, 2), (6, 6)):
            page = self.open(f"#case=family%2Fwrong&px={x},{y}")
            told = self.edgecase("explain", "family/wrong", "--pixel", f"{x},{y}")
            proved = {}
            for a, b, kind, value in re.findall(r"E\((\d+),(\d+)\) from .*?, a (\w+) edge: (-?[\d./]+)", told):
                proved[f"v{a}\u2192v{b}"] = (kind, self.number(value))
            self.assertGreaterEqual(len(proved), 3)
            shown = page.run("[...document.querySelectorAll('table.edges tbody tr')].map((r) => [...r.cells].map((c) => c.textContent))")
            self.assertGreaterEqual(len(shown), 3)
            for edge, kind, value, _ in shown:
                self.assertEqual((kind, self.number(value)), proved[edge])

    @staticmethod
    def number(text):
        top, _, bottom = text.replace("\u2212", "-").partition("/")
        return float(top) / float(bottom or 1)

    def test_values_with_bits_and_distances(self):
        page = self.open("#case=family%2Fwrong")
        rows = page.run("[...document.querySelectorAll('.values tbody')].map((r) => r.innerText)")
        attribute = [r for r in rows if r.startswith("attribute 0.x")]
        self.assertEqual(len(attribute), 1)
        self.assertRegex(attribute[0], r"0x[0-9a-f]{8}")
        self.assertRegex(attribute[0], r"\d+ ulp")
        self.assertRegex(attribute[0], r"[\d.]+ budgets")

    def test_rules_lead_to_the_specification(self):
        page = self.open("#case=family%2Fwrong")
        links = page.run("[...document.querySelectorAll('.broken a')].map((a) => a.href)")
        self.assertTrue(links)
        for link in links:
            self.assertTrue(link.startswith("https://registry.khronos.org/vulkan/specs/latest/html/vkspec.html#"), link)

    def test_multisample_cases_show_every_sample(self):
        page = self.open("#case=samples%2Ffour&px=3,3,0&zoom=64")
        seen = set()
        for _ in range(4):
            seen.add(page.text("#sample-summary"))
            page.key("]")
        self.assertEqual(seen, {f"Pixel (3, 3) sample {s} at ({3 + x / 16:g}, {3 + y / 16:g})"
                                for s, (x, y) in enumerate([(6, 2), (14, 6), (2, 10), (10, 14)])})
        zoom, (left, top) = 64, self.at(page, 3, 3)
        page.click_at(left + (14 / 16 - .5) * zoom, top + (6 / 16 - .5) * zoom)
        self.assertIn("sample 1", page.text("#sample-summary"))
        self.assertIn("px=3,3,1", page.run("location.hash"))

    def test_samples_on_edges_are_known_as_ties(self):
        page = self.open("#case=family%2Fwrong")
        ties = page.run("[...page.viewer.scene.ties].map((k) => k % 8 + ',' + Math.floor(k / 8)).sort()")
        self.assertEqual(ties, ["1,6", "2,5", "3,4", "4,3", "5,2", "6,1"])

    def test_blits_show_colours_and_source_coordinates(self):
        page = self.open("#case=texels%2Fblit&px=1,1")
        text = page.text(".inspector")
        self.assertIn("Texel (1, 1)", text)
        self.assertIn("expected colour", text)
        self.assertIn("device colour", text)
        self.assertIn("Source coordinate (1/3, 1/3)", text)

    def test_blits_are_written_not_covered(self):
        page = self.open("#case=texels%2Fblit")
        shown = page.text(".bench")
        for text in ("Triangles", "Samples", "covered"):
            self.assertNotIn(text, shown)
        self.assertIn("written", page.text(".mark-line"))
        page.key("ArrowRight")
        self.assertIn("Texel (", page.text("#announcer"))
        self.assertIn("must be written, device: written", page.text("#announcer"))

    def test_a_value_tells_its_fraction_where_it_says_more(self):
        page = self.open()
        row = "valueRow(['depth', '%s', '%s', '1e-9', '0', '1', null], [], false, %s).textContent"
        self.assertIn("depth\u22123[0, 1]not compared", page.run(row % ("-3", "-3", "true")))
        self.assertIn("depth\u22122.5 = \u22125/2[0, 1]not drawn", page.run(row % ("-5/2", "-2.5", "false")))

    def test_errors_fit_their_cells(self):
        page = self.open()
        texts = page.run("Array.from({length: 254}, (_, k) => errorNumber(k + 1))")
        self.assertEqual((texts[0], texts[127], texts[244], texts[253]), ("0", "1", "2.5e4", "5.5e4"))
        self.assertLessEqual(max(map(len, texts)), 6)

    def test_an_address_names_any_id(self):
        folder = self.folder / "plus"
        folder.mkdir()
        journal = (self.out / "journal.jsonl").read_text(encoding="utf-8")
        (folder / "journal.jsonl").write_text(journal.replace("family/wrong", "family/wrong:of=color+depth,b=0"), encoding="utf-8")
        self.edgecase("report", folder)
        for written in ("family/wrong:of=color+depth,b=0", "family%2Fwrong%3Aof%3Dcolor%2Bdepth%2Cb%3D0"):
            page = self.open(f"#case={written}&px=2,5", file=folder / "report.html")
            self.assertEqual(page.text("#case-title"), "family/wrong:of=color+depth,b=0")
            self.assertIn("Pixel (2, 5)", page.text("#sample-summary"))
        page = self.open("#q=four+samples")
        self.assertEqual(page.run("byId('filter').value"), "four samples")

    def test_an_unknown_id_is_told(self):
        page = self.open("#case=no/such:a=b+c")
        self.assertEqual(page.text("#unknown"), "There is no case no/such:a=b+c in this report.")
        page.click("#filter")
        page.type("four")
        self.assertEqual(page.count("#unknown"), 0)
        page.run("location.hash = '#case=family%2Fgood'")
        page.wait_for("document.getElementById('case-title') !== null")
        page.run("location.hash = '#case=other'")
        page.wait_for("!document.getElementById('unknown').hidden")
        self.assertEqual(page.text("#unknown"), "There is no case other in this report.")

    def test_a_bad_address_is_harmless(self):
        page = self.open("#case=family%2Fwrong&px=99,-3,x&view=nothing&zoom=1e9")
        self.assertEqual(page.text("#case-title"), "family/wrong")
        page = self.open("#case=no%2Fsuch")
        self.assertEqual(page.count("#list tr.case-row"), 4)


# The second draw is cut to the two columns on the left.
CUT = SQUARE.format(more=" and one that its scissor cuts off", target="", draw="[[draw.attribute]]\nvalues = [0, 1, 2, 3, 4, 5]") + """[[draw]]
vertices = [[1,1], [7,1], [1,7],  [7,1], [7,7], [1,7]]
scissor = [0, 0, 2, 8]
"""


class Shapes(PageTest):
    cases = {"shapes/cut": CUT, "shapes/flat": SQUARE.format(more=" in a flat target", target="", draw="").replace("[8, 8]", "[1024, 8]"),
             "shapes/tall": SQUARE.format(more=" in a tall target", target="", draw="").replace("[8, 8]", "[8, 1024]")}
    fault = "flip-pixel"
    scrollbars = True

    def test_the_scissor_is_told(self):
        page = self.open("#case=shapes%2Fcut&px=4,4")
        cut = page.run("[...document.querySelectorAll('.triangle summary')].filter((s) => s.innerText.includes('inside')).map((s) => s.innerText)")
        self.assertEqual(len(cut), 2, cut)
        self.assertEqual([("the scissor rectangle, x 0 to 2, y 0 to 8, leaves this pixel out" in s, "draw 1" in s) for s in cut].count((True, True)), 1, cut)
        self.assertEqual([("the scissor rectangle, x 0 to 2, y 0 to 8, leaves this pixel out" in s, "draw 1" in s) for s in cut].count((False, False)), 1, cut)
        page = self.open("#case=shapes%2Fcut&px=1,4")
        self.assertNotIn("scissor", page.text(".triangles"))

    def test_what_was_drawn_too_often_is_not_called_not_drawn(self):
        page = self.open()
        # As where no triangle that may be here wrote last.
        page.run("entryOf.get('shapes/cut').record.evidence.forEach((e) => e.values.forEach((v) => { v[6] = null; }))")
        page.run("openCase('shapes/cut')")
        self.assertIn("not compared", page.text(".values"))
        self.assertNotIn("not drawn", page.text(".values"))

    def test_scrollbars_take_no_room_of_the_picture(self):
        for case, scrolled in (("flat", "Width"), ("tall", "Height")):
            for view in ("difference", "side"):
                page = self.open(f"#case=shapes%2F{case}&view={view}&zoom=16")
                for frame in page.run("[...document.querySelectorAll('.frame')].map((f) => ({Width: [f.scrollWidth, f.clientWidth],"
                                      "Height: [f.scrollHeight, f.clientHeight], bars: f.offsetWidth - f.clientWidth + f.offsetHeight - f.clientHeight}))"):
                    self.assertGreater(frame["bars"], 4, "there is no scrollbar to be seen")
                    for side in ("Width", "Height"):
                        self.assertEqual(frame[side][0] > frame[side][1], side == scrolled, (case, view, frame))

    def test_a_picture_that_fits_needs_no_scrollbar(self):
        page = self.open("#case=shapes%2Fcut")
        frame = "document.querySelector('.frame')"
        for view in ("difference", "side"):
            for width in range(1400, 1440, 3):
                page.send("Emulation.setDeviceMetricsOverride", {"width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": False})
                page.run(f"(() => {{ page.viewer.setView('{view}'); page.viewer.setZoom(64); page.viewer.setZoom(0); }})()")
                sizes = page.run(f"[{frame}.offsetWidth - {frame}.scrollWidth, {frame}.offsetHeight - {frame}.scrollHeight,"
                                 f"{frame}.offsetWidth - {frame}.firstChild.offsetWidth, {frame}.offsetHeight - {frame}.firstChild.offsetHeight]")
                self.assertEqual(sizes, [2, 2, 2, 2], (width, view))


class Size(PageTest):
    def test_thousands_of_cases_stay_small_and_open(self):
        folder = self.folder / "many"
        folder.mkdir()
        (folder / "journal.jsonl").write_text(self.journal_of(2000, 300), encoding="utf-8")
        self.edgecase("report", folder)
        report = folder / "report.html"
        self.assertLess(report.stat().st_size, MOST_BYTES)
        page = self.open(file=report)
        self.assertIn("2000 of 2000 cases", page.text("#shown"))
        self.assertEqual(page.text("#statuses [data-status=fail] .tally"), "300")
        page.key("n")
        self.assertIn("many/wrong", page.text("#case-title"))
        self.assertEqual(page.count(".frame canvas"), 1)

    def test_what_does_not_fit_stands_in_further_pages(self):
        folder = self.folder / "more"
        folder.mkdir()
        (folder / "journal.jsonl").write_text(self.journal_of(420, 400), encoding="utf-8")
        self.edgecase("report", folder)
        parts = sorted(folder.glob("report*.html"))
        self.assertEqual([p.name for p in parts], ["report-2.html", "report.html"])
        for part in parts:
            self.assertLess(part.stat().st_size, MOST_BYTES)
        page = self.open(file=folder / "report.html")
        self.assertIn("stand in report-2.html", page.text(".note"))
        elsewhere = page.run("data.cases.find((c) => c.part === 2).id")
        page.run(f"openCase({json.dumps(elsewhere)})")
        page.click(".case-page .note a")
        page.wait_for("location.pathname.endsWith('report-2.html') && document.getElementById('case-title') !== null")
        self.assertEqual(page.text("#case-title"), elsewhere)
        self.assertEqual(page.count(".frame canvas"), 1)

    def journal_of(self, cases, failing):
        """A run as the program writes it, of as many cases: those that fail have 64 x 64 pixels, 300 findings, 32 samples with values."""
        records = [json.loads(line) for line in (self.out / "journal.jsonl").read_text(encoding="utf-8").splitlines()]
        ends = {r["id"]: r for r in records if r["record"] == "end"}
        noise = random.Random(1)
        wrong = ends["family/wrong"]
        planes = {"expected_hits": [0, 1], "device_hits": [1] * 9 + [2], "marks": [0] * 9 + [4], "errors": [1, 128, 140]}
        pictures = [{plane: self.picture(noise.choices(values, k=64 * 64)) for plane, values in planes.items()} for _ in range(4)]
        made = []
        for k in range(cases):
            record = dict(wrong if k < failing else ends["family/good"])
            record["id"] = f"many/{'wrong' if k < failing else 'good'}:n={k}"
            if k < failing:
                place = [(noise.randrange(64), noise.randrange(64)) for _ in range(300)]
                record["findings"] = [dict(wrong["findings"][0], x=x, y=y, why=f"number {k} of {x * y}") for x, y in place]
                record["counts"] = [0, 0, 300, 0, 0]
                record["evidence"] = [dict(wrong["evidence"][0], at=[x, y, 0]) for x, y in place[:32]]
                record["pictures"] = dict(wrong["pictures"], **pictures[k % len(pictures)], width=64, height=64, device_depths="", expected_depths="")
            made.append(record)
        head = next(r for r in records if r["record"] == "run")
        head["cases"] = [{key: m[key] for key in ("id", "file", "line", "description", "rules", "links", "rerun", "catches")} for m in made]
        lines = [head] + [r for r in records if r["record"] == "device"] + made + [r for r in records if r["record"] == "stop"]
        return "".join(json.dumps(line) + "\n" for line in lines)

    @staticmethod
    def picture(values):
        """As report/journal/picture_codec.hpp, a run a byte."""
        return base64.b64encode(bytes(b for value in values for b in (0, value))).decode()


if __name__ == "__main__":
    unittest.main()
