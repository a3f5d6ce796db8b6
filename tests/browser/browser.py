"""A headless Chromium, spoken to in the DevTools protocol through a pair of pipes: no socket, no
network, nothing but the standard library."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time
import urllib.parse

# Name and address of what the buttons of this name in the tools of these elements save, or of one of them.
SAVED = """(within, name, number) => {
  const saved = [], click = HTMLAnchorElement.prototype.click;
  HTMLAnchorElement.prototype.click = function () { saved.push([this.download, this.href]); };
  const all = [...document.querySelectorAll(within)];
  for (const element of number === null ? all : [all[number]])
    for (const button of element.querySelectorAll('.tools button')) if (button.textContent === name) button.click();
  HTMLAnchorElement.prototype.click = click;
  return saved;
}"""


class Browser:
    """One page of one browser; whatever it complains about is in `complaints`, and every address
    that it asks for in `requests`."""

    def __init__(self, program="chromium"):
        self.complaints, self.requests = [], []
        self._folder = tempfile.mkdtemp(prefix="vitrel-browser-")
        commands, self._commands = os.pipe()
        self._answers, answers = os.pipe()

        def wire():
            # High numbers first: the pipes may sit on 3 and 4 the wrong way round.
            os.dup2(commands, 100), os.dup2(answers, 101)
            os.dup2(100, 3), os.dup2(101, 4)

        options = ["--headless=new", "--remote-debugging-pipe", "--no-first-run", "--disable-gpu",
                   "--disable-dev-shm-usage", "--enable-unsafe-swiftshader", "--disable-background-networking", "--disable-sync",
                   "--disable-component-update", "--hide-scrollbars", f"--user-data-dir={self._folder}"]
        if os.geteuid() == 0:
            options.append("--no-sandbox")
        self._process = subprocess.Popen([program, *options, "about:blank"], preexec_fn=wire, close_fds=False,
                                         stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                         stderr=subprocess.DEVNULL)
        os.close(commands), os.close(answers)
        self._buffer, self._number, self._session = b"", 0, None
        target = next(t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self._session = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.terminate()
        self._process.wait(30)
        os.close(self._commands), os.close(self._answers)
        shutil.rmtree(self._folder, ignore_errors=True)

    def _receive(self, deadline):
        while b"\0" not in self._buffer:
            ready, _, _ = select.select([self._answers], [], [], max(0, deadline - time.monotonic()))
            part = os.read(self._answers, 1 << 20) if ready else b""
            if not part:
                raise TimeoutError("the browser does not answer")
            self._buffer += part
        message, self._buffer = self._buffer.split(b"\0", 1)
        return json.loads(message)

    def _note(self, message):
        method, what = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.complaints.append(json.dumps(what["exceptionDetails"]))
        elif method == "Runtime.consoleAPICalled" and what["type"] in ("error", "warning", "assert"):
            self.complaints.append(json.dumps(what["args"]))
        elif method == "Log.entryAdded" and what["entry"]["level"] in ("error", "warning"):
            # The software renderer that stands in for a graphics card says this of every picture of WebGL.
            if "GPU stall due to ReadPixels" not in what["entry"]["text"]:
                self.complaints.append(what["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(what["request"]["url"])
        return method

    def call(self, method, **parameters):
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._commands, json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + 60
        while True:
            answer = self._receive(deadline)
            self._note(answer)
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def open(self, address):
        self.call("Page.navigate", url=address)
        deadline = time.monotonic() + 60
        while self.evaluate("document.readyState") != "complete":
            if time.monotonic() > deadline:
                raise TimeoutError(f"{address} does not load")
            time.sleep(0.05)
        self.settle()

    def evaluate(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{expression}: {json.dumps(result['exceptionDetails'])}")
        return result["result"].get("value")

    def settle(self):
        """Waits until two more frames are drawn."""
        self.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def resize(self, width, height, scheme="light", reduced_motion=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        motion = "reduce" if reduced_motion else "no-preference"
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme},
                                                          {"name": "prefers-reduced-motion", "value": motion}])
        self.settle()

    def press(self, key, code=0, text="", modifiers=0, settle=True):
        """A key as a person presses it; `code` as in KeyboardEvent.keyCode, modifiers 8: shift. The page has handled it
        at the end; what it draws, it has drawn only when settled.
        """
        event = {"key": key, "windowsVirtualKeyCode": code, "modifiers": modifiers}
        self.call("Input.dispatchKeyEvent", type="keyDown", text=text, **event)
        self.call("Input.dispatchKeyEvent", type="keyUp", **event)
        if settle:
            self.settle()

    def wheel(self, x, y, delta):
        self.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=delta)
        self.settle()

    def saved(self, button, within=".chart", number=None):
        """Name and text of what the buttons of this name hand to the browser to save, of all charts or of one."""
        self.settle()
        found = self.evaluate(f"({SAVED})({', '.join(map(json.dumps, (within, button, number)))})")
        return [(name, urllib.parse.unquote(address.split(",", 1)[1])) for name, address in found]

    def screenshot(self, path, whole_page=True):
        options = {"captureBeyondViewport": whole_page}
        image = self.call("Page.captureScreenshot", format="png", **options)
        with open(path, "wb") as file:
            file.write(base64.b64decode(image["data"]))
