"""Chromium without a window, through chromedriver and its protocol (W3C WebDriver): Python's standard library only."""
import base64
import contextlib
import json
import os
import re
import subprocess
import tempfile
import urllib.error
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"


class Browser:
    """A page at a time. Its log and network requests are kept until they are fetched."""

    def __init__(self, driver, size):
        self.driver = driver
        options = {"args": ["--headless=new", "--disable-gpu", "--hide-scrollbars", "--force-device-scale-factor=1", "--disable-dev-shm-usage",
                            "--window-size=%d,%d" % size] + (["--no-sandbox"] if os.geteuid() == 0 else [])}
        wanted = {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}
        self.session = self._call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})["sessionId"]
        self.resize(*size)

    def _call(self, method, path, body=None):
        data = None if method != "POST" else json.dumps(body or {}).encode()
        request = urllib.request.Request(self.driver + path, data=data, method=method, headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=300) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError("%s %s: %s" % (method, path, json.load(error)["value"]["message"])) from error

    def call(self, method, path, body=None):
        return self._call(method, "/session/%s%s" % (self.session, path), body)

    def devtools(self, command, **parameters):
        return self.call("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def resize(self, width, height):
        """The inner size of the window."""
        self.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def dark(self, wanted=True):
        self.devtools("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if wanted else "light"}])

    def open(self, path):
        self.messages(), self.requests()
        self.call("POST", "/url", {"url": "file://" + str(path)})

    def run(self, script, *arguments):
        """The result of a function's body in the page."""
        return self.call("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def find(self, selector):
        return self.call("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self.call("POST", "/element/%s/click" % self.find(selector))

    def wheel(self, selector, by):
        """Turns the wheel over the middle of an element, `by` > 0: down."""
        scroll = {"type": "scroll", "x": 0, "y": 0, "deltaX": 0, "deltaY": by, "origin": {ELEMENT: self.find(selector)}}
        self.call("POST", "/actions", {"actions": [{"type": "wheel", "id": "wheel", "actions": [scroll]}]})

    def drag(self, selector, begin, end):
        """Drags from one point of an element to another, both relative to its middle."""
        def move(x, y):
            return {"type": "pointerMove", "duration": 50, "x": x, "y": y, "origin": {ELEMENT: self.find(selector)}}
        actions = [move(*begin), {"type": "pointerDown", "button": 0}, move(*end), {"type": "pointerUp", "button": 0}]
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": actions}]})

    def messages(self):
        """The page's output to the console."""
        return [each["message"] for each in self.call("POST", "/se/log", {"type": "browser"})]

    def requests(self):
        """The addresses that the page has requested."""
        events = [json.loads(each["message"])["message"] for each in self.call("POST", "/se/log", {"type": "performance"})]
        return [each["params"]["request"]["url"] for each in events if each["method"] == "Network.requestWillBeSent"]

    def picture(self, path, selector=None):
        """A PNG of an element, as far as the window shows it, or of the window."""
        if selector:
            self.run("document.querySelector(arguments[0]).scrollIntoView()", selector)
        at = "/element/%s/screenshot" % self.find(selector) if selector else "/screenshot"
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.call("GET", at)))


@contextlib.contextmanager
def browser(size=(1280, 1000), driver="chromedriver"):
    """Both end with the block."""
    with tempfile.TemporaryDirectory(prefix="dsdpv1_browser_") as folder:
        environment = {**os.environ, "HOME": folder, "TMPDIR": folder}
        process = subprocess.Popen([driver, "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=environment)
        page = None
        try:
            port = next(found.group(1) for line in process.stdout if (found := re.search(r"started successfully on port (\d+)", line)))
            page = Browser("http://127.0.0.1:" + port, size)
            yield page
        finally:
            if page:
                page.call("DELETE", "")
            process.terminate()
            process.communicate()
