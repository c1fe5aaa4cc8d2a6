# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""What is disturbed: runs of a suite, hunts and reductions. Each tells how its outcome may differ from the undisturbed
one: not at all, or in what it names."""
import json
import os
import pathlib
import re
import subprocess
import tempfile
import xml.etree.ElementTree

import schema
from place import PROGRAM, SOURCE

# Some 150 leaves; without expectation files some fail on lavapipe 22.3.
SELECTORS = ["ties/**", "coverage/**", "depth-bias/clipped-exponent", "scissor/far-end", "stencil/faces*", "multisample/clipped",
             "scissor/rectangles:x=65536,w=1,*"]
CHARGED = {"crash", "timeout", "flake", "device_lost", "error"}
INTERRUPTED = 130


def load(path, name, said):
    """A JSON file that has to be whole and as its schema says, and is nothing if there is none."""
    if not path.exists():
        return None
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        said.append(f"{path.name} is not whole: {error}")
        return None
    shape = json.loads((SOURCE / "docs" / "schema" / f"{name}.json").read_text(encoding="utf-8"))
    said += [f"{path.name}{problem}" for problem in schema.problems(value, shape)[:3]]
    return value


def is_shown(text, symptom, words, env):
    """Whether a case that a hunt has kept shows its symptom where nothing is disturbed."""
    kind, _, rule = symptom.split(" [")[0].partition(" of ")
    with tempfile.TemporaryDirectory() as folder:
        file, out = pathlib.Path(folder, "found.toml"), pathlib.Path(folder, "out")
        file.write_text(text, encoding="utf-8")
        subprocess.run([PROGRAM, "run", file, "--no-expect", "--no-diagnosis", "-q", *words, "-o", out], env=os.environ | env,
                       capture_output=True, timeout=120, check=False)
        results = out / "results.json"
        cases = json.loads(results.read_text(encoding="utf-8"))["cases"] if results.exists() else []
        return any((f["kind"], f["rule"]) == (kind, rule) for case in cases for f in case["findings"])


class Suite:
    resumes = True

    def __init__(self, renderer):
        self.name = f"suite on {renderer}"
        self.needs_driver = renderer == "vulkan"
        self.env = {}
        self.options = ["--no-expect", "--no-diagnosis", "--timeout", "4", "-j", "2", "--renderer", renderer]

    def words(self, place):
        return ["run", *SELECTORS, *self.options, "-o", place.out / "run"]

    def resume_words(self, place):
        return ["run", "--resume", place.out / "run"]

    def read(self, place, said):
        """What is compared of each case; nothing if there are no results."""
        folder = place.out / "run"
        results = load(folder / "results.json", "results-1", said)
        if results is None:
            return None
        try:
            xml.etree.ElementTree.parse(folder / "junit.xml")
        except (OSError, xml.etree.ElementTree.ParseError) as error:
            said.append(f"junit.xml: {error}")
        page = folder / "report.html"
        if not page.exists() or not page.read_text(encoding="utf-8").rstrip().endswith("</html>"):
            said.append("report.html does not end")
        return {"code": results["run"]["exit_code"], "cases": {case["id"]: case for case in results["cases"]}}

    KEYS = ("status", "bits", "hit_bits", "groups", "finding_total", "findings")

    def differences(self, base, now, end, said):
        """How many cases are not as undisturbed; each has to be named."""
        if now is None:
            return 0
        if now["code"] != end.code:
            said.append(f"results.json tells of exit {now['code']}, the program ended with {end.code}")
        if sorted(now["cases"]) != sorted(base["cases"]):
            said.append("results.json has other cases")
        count = 0
        for name, case in now["cases"].items():
            was = base["cases"].get(name)
            if was is None or all(case[key] == was[key] for key in self.KEYS):
                continue
            count += 1
            is_left = case["status"] in ("not_run", "skip") and end.code in (INTERRUPTED, 7)
            if case["status"] not in CHARGED and not is_left:
                said.append(f"{name} is {case['status']} instead of {was['status']}" if case["status"] != was["status"] else
                            f"{name} is {case['status']} with other bits or findings")
            elif not case["reason"] and not is_left:
                said.append(f"{name} is {case['status']} without a reason")
        return count

    def is_alike(self, base, now):
        return self.is_equal(base, now)

    def is_equal(self, base, now):
        return now is not None and all(now["cases"].get(name, {}).get(key) == case[key]
                                       for name, case in base["cases"].items() for key in self.KEYS)


class Hunt:
    resumes = True

    def __init__(self, name, words, env, cases):
        self.name = name
        self.needs_driver = "reference" not in words
        self.env = env
        self.start = ["fuzz", *words, "--no-expect", "-q", "-j", "2", "--timeout", "4"]
        self.cases = ["--cases", str(cases)]
        self.renderer = words[:2] if "reference" in words else []  # which a hunt has to be told again

    def words(self, place):
        return [*self.start, *self.cases, "-o", place.out / "hunt"]

    def resume_words(self, place):
        return ["fuzz", "--resume", place.out / "hunt", "-q", *self.renderer, *self.cases]

    def read(self, place, said):
        ledger = load(place.out / "hunt" / "fuzz.json", "fuzz-1", said)
        if ledger is None:
            return None
        causes = {}
        for cause in ledger["causes"]:
            file = place.out / "hunt" / cause["file"]
            if not file.exists() or not file.read_text(encoding="utf-8").endswith("\n"):
                said.append(f"{cause['file']} of fuzz.json is not whole")
            elif cause["is_reduced"]:
                causes[cause["symptom"], tuple(cause["essentials"])] = file.read_text(encoding="utf-8")
        done = {name: ledger[name] for name in ("is_finished", "judged_cases", "failed_cases")}
        return {"causes": causes, "done": done, "unjudged": ledger["unjudged_cases"]}

    def differences(self, base, now, end, said):
        if now is None:
            return 0
        # A cause of a hunt that deaths disturbed is reduced along another way; its symptom is one that there is, or that
        # the kept case shows without any disturbance.
        symptoms = {symptom for symptom, _ in base["causes"]}
        others = [(symptom, text) for (symptom, _), text in now["causes"].items() if symptom not in symptoms]
        said += [f"the hunt found '{symptom}', which is not there" for symptom, text in others
                 if not symptom.startswith(("crash", "timeout", "device lost", "error", "flake"))
                 and not is_shown(text, symptom, self.renderer, self.env)]
        if end.code == 0 and base["causes"]:
            said.append("the hunt ended with 0, and the undisturbed one found causes")
        return 0 if now["causes"] == base["causes"] and now["done"] == base["done"] else 1

    def words_of(self, base, now):
        """What of two hunts differs, for whoever reads the line of a wrong round."""
        texts = [f"{symptom} needs {needs}" for symptom, needs in set(base["causes"]) ^ set(now["causes"])]
        texts += [f"another text of {key[0]}" for key in set(base["causes"]) & set(now["causes"]) if base["causes"][key] != now["causes"][key]]
        return texts + [f"{key} is {now['done'][key]} instead of {value}" for key, value in base["done"].items() if now["done"][key] != value]

    def is_equal(self, base, now):
        return now is not None and now["causes"] == base["causes"] and now["done"] == base["done"]

    def is_alike(self, base, now):
        """Of a hunt that goes on: its causes were met in another order, so another case of each may have been reduced."""
        return now is not None and set(now["causes"]) == set(base["causes"]) and now["done"] == base["done"]


class Reduction:
    name = "reduction"
    resumes = False
    needs_driver = True
    env = {"EDGECASE_FAULT": "flip-pixel@**"}

    def words(self, place):
        return ["reduce", "mesh/strip:grid=0", "--timeout", "4", "-o", place.out / "small.toml"]

    def read(self, place, said):
        file = place.out / "small.toml"
        if not file.exists():
            return None
        text = file.read_text(encoding="utf-8")
        if not text.rstrip().endswith("]"):
            said.append("small.toml is not whole")
        return text

    def differences(self, base, now, end, said):
        if now is None and end.code == 0:
            said.append("the reduction ended with 0 and without a file")
        reasons = "crash|timeout|device lost|flake|had no sure result|interrupted; what it had come to is written"
        if now not in (None, base) and not re.search(reasons, now + end.errors):
            said.append(f"the reduction is another one, and no word says why: {end.errors.strip()[-200:]}")
        return 0 if now in (None, base) else 1

    def is_equal(self, base, now):
        return now == base


WORKLOADS = {
    "suite": Suite("vulkan"),
    "suite-reference": Suite("reference"),
    "hunt": Hunt("hunt", ["scissor/**", "depth-bias/**", "clip/**", "snap/**", "--seed", "2"], {}, 600),
    "hunt-reference": Hunt("hunt on reference", ["--renderer", "reference", "--seed", "1"], {"EDGECASE_FAULT": "flip-pixel@*"}, 60),
    "reduce": Reduction(),
}
