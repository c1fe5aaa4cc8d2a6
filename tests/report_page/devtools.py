# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""A headless Chromium driven by the DevTools protocol over two pipes (--remote-debugging-pipe): no port, no package.

Messages are JSON objects, each followed by a NUL byte. https://chromedevtools.github.io/devtools-protocol/
"""
import base64
import fcntl
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

TIMEOUT = 60  # seconds that an answer may take

# What the browser answers to an expression whose page is left for another meanwhile, or is not there yet.
BETWEEN_PAGES = ("Inspected target navigated or closed", "Execution context was destroyed", "Cannot find context",
                 "Cannot find default execution context")


def find_chromium():
    """The browser's path, or None: EDGECASE_CHROMIUM or one of the usual names."""
    for name in (os.environ.get("EDGECASE_CHROMIUM"), "chromium", "chromium-browser", "google-chrome"):
        if name and shutil.which(name):
            return shutil.which(name)
    return None


class Refused(RuntimeError):
    """The browser's answer to a command is an error."""


class Browser:
    def __init__(self, program, scrollbars=False):
        self.profile = tempfile.mkdtemp(prefix="edgecase-chromium-")
        commands_read, self.commands = self._pipe(keep=0)
        self.answers, answers_write = self._pipe(keep=1)
        # The shell moves the ends to the numbers that Chromium wants: 3 to read, 4 to write.
        script = f'exec "$0" "$@" 3<&{commands_read} 4>&{answers_write} {commands_read}<&- {answers_write}>&-'
        self.process = subprocess.Popen(
            ["bash", "-c", script, program, "--headless=new", "--remote-debugging-pipe", "--no-sandbox", "--disable-gpu",
             "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions", "--disable-background-networking",
             "--disable-component-update", "--disable-sync", "--force-device-scale-factor=1",
             *([] if scrollbars else ["--hide-scrollbars"]), f"--user-data-dir={self.profile}"],
            pass_fds=(commands_read, answers_write), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(commands_read)
        os.close(answers_write)
        self.buffer = b""
        self.number = 0
        self.events = []

    @staticmethod
    def _pipe(keep):
        """A pipe whose ends have numbers above 9; end `keep` is for the browser, the other for us."""
        pair = os.pipe()
        ends = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in pair]
        for end in pair:
            os.close(end)
        os.set_inheritable(ends[keep], True)
        return ends

    def close(self):
        try:
            self.send("Browser.close")
        except (OSError, RuntimeError, TimeoutError):
            pass
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        os.close(self.commands)
        os.close(self.answers)
        shutil.rmtree(self.profile, ignore_errors=True)

    def send(self, method, parameters=None, session=None):
        """Sends a command and returns its result; events that come meanwhile are kept."""
        self.number += 1
        number = self.number
        message = {"id": number, "method": method, "params": parameters or {}}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.commands, data):]
        end = time.monotonic() + TIMEOUT
        while True:
            answer = self._receive(end)
            if answer.get("id") == number:
                if "error" in answer:
                    raise Refused(f"{method}: {answer['error'].get('message')}")
                return answer["result"]
            if "method" in answer:
                self.events.append(answer)

    def _receive(self, end):
        while b"\0" not in self.buffer:
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.answers], [], [], left)[0]:
                raise TimeoutError("the browser does not answer")
            chunk = os.read(self.answers, 1 << 20)
            if not chunk:
                raise RuntimeError("the browser has ended")
            self.buffer += chunk
        text, _, self.buffer = self.buffer.partition(b"\0")
        return json.loads(text)


class Page:
    """One tab. `width` and `height` of the window in pixels; `dark`: what the system prefers."""

    def __init__(self, browser, width=1440, height=1000, dark=False):
        self.browser = browser
        target = browser.send("Target.createTarget", {"url": "about:blank"})["targetId"]
        self.target = target
        self.session = browser.send("Target.attachToTarget", {"targetId": target, "flatten": True})["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log", "DOM", "Accessibility"):
            self.send(domain + ".enable")
        self.send("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        self.send("Emulation.setEmulatedMedia", {"features": [
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
            {"name": "prefers-reduced-motion", "value": "reduce"}]})

    def send(self, method, parameters=None):
        return self.browser.send(method, parameters, self.session)

    def close(self):
        self.browser.send("Target.closeTarget", {"targetId": self.target})

    def open(self, file, hash_text=""):
        self.send("Page.navigate", {"url": "about:blank"})
        self.send("Page.navigate", {"url": pathlib.Path(file).resolve().as_uri() + hash_text})
        self.wait_for("document.readyState === 'complete' && location.protocol === 'file:'")

    def run(self, expression):
        """The value of a JavaScript expression."""
        answer = self.send("Runtime.evaluate", {"expression": expression, "returnByValue": True})
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise AssertionError(f"{expression}: {details.get('exception', {}).get('description', details)}")
        return answer["result"].get("value")

    def wait_for(self, expression):
        """Waits until an expression is true, here or in the page that a link leads to."""
        end = time.monotonic() + TIMEOUT
        while not self._is_true(expression):
            if time.monotonic() > end:
                raise AssertionError(f"never true: {expression}")
            time.sleep(0.02)

    def _is_true(self, expression):
        """False, too, where the page was left while the expression ran: it says nothing of the next one."""
        try:
            return self.run(expression)
        except Refused as refused:
            if not any(text in str(refused) for text in BETWEEN_PAGES):
                raise
            return False

    def text(self, selector):
        return self.run(f"(document.querySelector({json.dumps(selector)}) || {{innerText: ''}}).innerText")

    def count(self, selector):
        return self.run(f"[...document.querySelectorAll({json.dumps(selector)})].filter((e) => e.getClientRects().length > 0).length")

    def click_at(self, x, y):
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self.send("Input.dispatchMouseEvent", {"type": kind, "x": x, "y": y, "button": "none" if kind == "mouseMoved" else "left",
                                                   "clickCount": 0 if kind == "mouseMoved" else 1})

    def move_to(self, x, y):
        self.send("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": x, "y": y})

    def box(self, selector):
        box = self.run(f"(() => {{ const e = document.querySelector({json.dumps(selector)}); if (!e) return null; "
                       "e.scrollIntoView({block: 'nearest'}); const r = e.getBoundingClientRect(); return [r.x, r.y, r.width, r.height]; })()")
        if box is None:
            raise AssertionError(f"there is no {selector}")
        return box

    def click(self, selector):
        x, y, width, height = self.box(selector)
        self.click_at(x + width / 2, y + height / 2)

    def click_seen(self, selector):
        """As click(), of something that a reader sees there: nothing lies over it."""
        x, y, width, height = self.box(selector)
        spot = [x + min(width / 2, 40), y + height / 2]
        seen = self.run(f"(() => {{ const e = document.querySelector({json.dumps(selector)}), at = document.elementFromPoint(...{spot}); "
                        "return Boolean(at) && (e === at || e.contains(at)); })()")
        if not seen:
            raise AssertionError(f"{selector} is not to be seen at {spot}")
        self.click_at(*spot)

    def key(self, key):
        """Presses a key as a keyboard would: "n", "+", "ArrowLeft", "Escape"."""
        codes = {"Escape": 27, "Enter": 13, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "Tab": 9}
        event = {"key": key, "text": key} if len(key) == 1 else {"key": key, "code": key, "windowsVirtualKeyCode": codes[key]}
        self.send("Input.dispatchKeyEvent", {"type": "keyDown", **event})
        self.send("Input.dispatchKeyEvent", {"type": "keyUp", "key": key})

    def type(self, text):
        self.send("Input.insertText", {"text": text})

    def screenshot(self, file):
        pathlib.Path(file).write_bytes(base64.b64decode(self.send("Page.captureScreenshot", {"format": "png"})["data"]))

    def requests(self):
        """Addresses that the page has asked for, its own left out."""
        return [e["params"]["request"]["url"] for e in self._events("Network.requestWillBeSent")
                if e["params"].get("type") != "Document"]

    def complaints(self):
        """What stands in the console, and exceptions."""
        # The tests read canvases back, which Chromium calls slow.
        logged = [str(e["params"]["entry"]) for e in self._events("Log.entryAdded") if "willReadFrequently" not in str(e)]
        called = [str(e["params"]["args"]) for e in self._events("Runtime.consoleAPICalled")]
        thrown = [str(e["params"]["exceptionDetails"].get("exception", {}).get("description"))
                  for e in self._events("Runtime.exceptionThrown")]
        return logged + called + thrown

    def _events(self, method):
        return [e for e in self.browser.events if e["method"] == method and e.get("sessionId") == self.session]
