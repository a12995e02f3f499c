"""A headless Chromium that opens one file, driven over the DevTools protocol through pipes: Python's own library suffices."""
import base64
import fcntl
import json
import os
import shutil
import subprocess
import tempfile
import time

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FLAGS = ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
         "--no-first-run", "--disable-background-networking", "--disable-dev-shm-usage", "--remote-debugging-pipe"]


class Browser:
    """`with Browser(path) as page:` loads the file and waits for nothing. `faults` gathers messages of the console, exceptions and
    requests for anything but the file itself."""

    def __init__(self, path, width=1400, height=1000, fineness=1):
        self.folder = tempfile.TemporaryDirectory()
        self.faults, self.number = [], 0
        self.metrics = {"width": width, "height": height, "deviceScaleFactor": fineness, "mobile": False}
        self.url = "file://" + os.path.abspath(path)
        to_read, self.to = os.pipe()
        self.source, from_write = os.pipe()
        ends = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (to_read, from_write)]

        def take_ends():  # Chromium reads commands from 3 and answers on 4
            os.dup2(ends[0], 3)
            os.dup2(ends[1], 4)

        flags = [f"--user-data-dir={self.folder.name}", f"--window-size={width},{height}"]
        self.process = subprocess.Popen([PROGRAM, *FLAGS, *flags, "about:blank"], preexec_fn=take_ends, pass_fds=(3, 4),
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        for end in (to_read, from_write, *ends):
            os.close(end)
        self.buffer, self.session = b"", None

    def __enter__(self):
        targets = self.ask("Target.getTargets")["targetInfos"]
        page = next(t["targetId"] for t in targets if t["type"] == "page")
        self.session = self.ask("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(domain + ".enable")
        self.ask("Emulation.setDeviceMetricsOverride", **self.metrics)
        self.ask("Page.navigate", url=self.url)
        return self

    def __exit__(self, *_):
        try:
            self.session = None
            self.ask("Browser.close")
            self.process.wait(20)
        except (OSError, RuntimeError, subprocess.TimeoutExpired):
            self.process.kill()
        self.process.wait()
        for end in (self.to, self.source):
            os.close(end)
        self.folder.cleanup()

    def ask(self, method, **params):
        self.number += 1
        message = {"id": self.number, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive()
            if answer.get("id") != self.number:
                self.note(answer)
                continue
            if "error" in answer:
                raise RuntimeError(f"{method}: {answer['error']}")
            return answer["result"]

    def receive(self):
        while b"\0" not in self.buffer:
            more = os.read(self.source, 1 << 20)
            if not more:
                raise RuntimeError("the browser has ended")
            self.buffer += more
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def note(self, event):
        method, params = event.get("method"), event.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.faults.append("exception: " + json.dumps(params["exceptionDetails"])[:600])
        elif method == "Runtime.consoleAPICalled":
            self.faults.append(f"console.{params['type']}: " + json.dumps(params["args"])[:600])
        elif method == "Log.entryAdded":
            self.faults.append("log: " + params["entry"]["text"][:600])
        elif method == "Network.requestWillBeSent":
            url = params["request"]["url"].split("#")[0]
            if url != self.url and not url.startswith(("data:", "blob:")):
                self.faults.append("request: " + url)

    def value(self, expression):
        """Of a JavaScript expression, promises awaited."""
        result = self.ask("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{expression}: {json.dumps(result['exceptionDetails'])[:600]}")
        return result["result"].get("value")

    def wait_for(self, expression, seconds=60):
        end = time.monotonic() + seconds
        while not self.value(expression):
            if time.monotonic() > end:
                raise RuntimeError(f"not within {seconds} s: {expression}; {self.faults}")
            time.sleep(.05)

    def picture(self, path, whole=False, clip=None):
        """Of what is seen, of the whole page or of its upper left corner (width, height), as a PNG file."""
        part = {"clip": {"x": 0, "y": 0, "width": clip[0], "height": clip[1], "scale": 1}} if clip else {}
        data = self.ask("Page.captureScreenshot", format="png", captureBeyondViewport=whole, **part)["data"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))
