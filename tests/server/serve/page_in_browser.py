#!/usr/bin/env python3
"""Opens the page of `herr serve` in a headless Chromium while a session is replayed, and looks at it: numbers,
pictures and charts change, nothing is said on the console, nothing is loaded from elsewhere, nothing is wider
than a phone, and the numbers are there without scripts.

page_in_browser.py HERR SESSION [FOLDER]: leaves screenshots in FOLDER. Exit 77: no Chromium here, skipped.
The browser is driven through its debugging pipe (Chrome DevTools Protocol), which needs no library."""

import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
LONGEST_S = 60  # for anything that is waited for; a busy machine is slow
DESKTOP, PHONE = (1280, 900), (390, 844)
# As root, without a graphics card, and without the browser's own traffic.
CHROMIUM_FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
                  "--disable-background-networking", "--disable-component-update", "--disable-sync")


class Browser:
    """One page of a headless Chromium."""

    def __init__(self, program, profile):
        to_browser, from_us = os.pipe()
        from_browser, to_us = os.pipe()

        def pipe_at_3_and_4():
            # By way of numbers that are surely neither.
            read_end, write_end = os.dup2(to_browser, 103), os.dup2(to_us, 104)
            os.dup2(read_end, 3)
            os.dup2(write_end, 4)

        self.process = subprocess.Popen(
            [program, *CHROMIUM_FLAGS, f"--user-data-dir={profile}", "--remote-debugging-pipe", "about:blank"],
            preexec_fn=pipe_at_3_and_4, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(to_us)
        self.out, self.into, self.bytes, self.number = from_us, from_browser, b"", 0
        self.complaints, self.urls, self.session = [], [], None
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(domain + ".enable")

    def message(self):
        deadline = time.monotonic() + LONGEST_S
        while b"\0" not in self.bytes:
            ready, _, _ = select.select([self.into], [], [], max(0, deadline - time.monotonic()))
            part = os.read(self.into, 1 << 20) if ready else b""
            if not part:
                raise SystemExit("the browser went away or fell silent")
            self.bytes += part
        one, self.bytes = self.bytes.split(b"\0", 1)
        return json.loads(one)

    def note(self, event):
        kind, told = event.get("method"), event.get("params", {})
        if kind == "Runtime.exceptionThrown":
            self.complaints.append(json.dumps(told["exceptionDetails"])[:500])
        elif kind == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
            self.complaints.append(json.dumps(told["args"])[:500])
        elif kind == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            self.complaints.append(told["entry"]["text"] + " " + told["entry"].get("url", ""))
        elif kind == "Network.requestWillBeSent":
            self.urls.append(told["request"]["url"])

    def ask(self, method, **parameters):
        self.number += 1
        request = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.out, json.dumps(request).encode() + b"\0")
        while True:
            message = self.message()
            if message.get("id") != self.number:
                self.note(message)
                continue
            if "error" in message:
                raise SystemExit(f"{method}: {message['error']}")
            return message["result"]

    def value(self, expression):
        result = self.ask("Runtime.evaluate", expression=expression, returnByValue=True)
        if "exceptionDetails" in result:
            raise SystemExit(f"{expression}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def wait_for(self, expression, what):
        deadline = time.monotonic() + LONGEST_S
        while time.monotonic() < deadline:
            if self.value(expression):
                return
            time.sleep(0.1)
        raise SystemExit(f"{what}: not within {LONGEST_S} s ({expression})")

    def size(self, width, height):
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                 mobile=width < 600)

    def screenshot(self, file):
        data = self.ask("Page.captureScreenshot", format="png", captureBeyondViewport=True)["data"]
        pathlib.Path(file).write_bytes(base64.b64decode(data))

    def close(self):
        self.process.kill()
        self.process.wait()


PICTURES = "[...document.querySelectorAll('#pictures img')]"
SEQUENCES = PICTURES + ".map((i) => Number(i.dataset.sequence || 0))"
POINTS = "Chart.getChart('chart-frame').data.datasets[0].data.length"
NUMBERS = "document.getElementById('numbers').innerText"


def check(right, what):
    if not right:
        raise SystemExit(what)


def look(browser, address, folder):
    browser.size(*DESKTOP)
    browser.ask("Page.navigate", url=address)
    browser.wait_for("document.readyState === 'complete'", "the page")
    # Four viewports and two polar buffers, each with its picture and then with a newer one.
    browser.wait_for(PICTURES + ".length === 6", "six pictures")
    browser.wait_for(SEQUENCES + ".every((n) => n > 0)", "a frame in every picture")
    before, numbers, points = browser.value(SEQUENCES), browser.value(NUMBERS), browser.value(POINTS)
    browser.wait_for(f"{SEQUENCES}.every((n, i) => n > {json.dumps(before)}[i])", "newer pictures")
    browser.wait_for(f"{NUMBERS} !== {json.dumps(numbers)}", "newer numbers")
    browser.wait_for(f"{POINTS} > {points}", "newer frames in the chart")
    check(browser.value(PICTURES + ".every((i) => i.naturalWidth > 8)"), "a picture is empty")
    for chart in ("chart-frame", "chart-load", "chart-stages", "chart-quality", "chart-ages"):
        check(browser.value(f"Chart.getChart('{chart}').data.datasets.some((d) => d.data.length > 1)"), chart)
    check("left out" in browser.value(NUMBERS), "the plan does not say what was left out")
    browser.screenshot(folder / "page-desktop.png")

    browser.size(*PHONE)
    time.sleep(1)
    overhang = browser.value("document.documentElement.scrollWidth - window.innerWidth")
    check(overhang <= 0, f"{overhang} pixels wider than a phone")
    browser.screenshot(folder / "page-phone.png")

    check(not browser.complaints, "on the console: " + "; ".join(browser.complaints))
    foreign = [u for u in browser.urls if not u.startswith((address, "blob:" + address, "about:"))]
    check(not foreign, f"loaded from elsewhere: {foreign}")

    browser.ask("Emulation.setScriptExecutionDisabled", value=True)
    browser.ask("Page.navigate", url=address)
    time.sleep(2)
    root = browser.ask("DOM.getDocument")["root"]["nodeId"]
    html = browser.ask("DOM.getOuterHTML", nodeId=root)["outerHTML"]
    check("first hits" in html and "per second" in html, "no numbers without scripts")


def main():
    program, session = sys.argv[1], sys.argv[2]
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if chromium is None:
        print("no chromium; apt-get install chromium")
        return 1 if "HERR_TOOLS_INSTALLED" in os.environ else SKIPPED
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else scratch)
        folder.mkdir(parents=True, exist_ok=True)
        server = subprocess.Popen([program, "serve", session, "--port", "0", "--profile", "xr1-half", "--polar",
                                   "512x256"], stdout=subprocess.PIPE, text=True)
        browser = None
        try:
            address = server.stdout.readline().strip()
            check(address.startswith("http://127.0.0.1:"), f"no address but {address!r}")
            browser = Browser(chromium, os.path.join(scratch, "profile"))
            look(browser, address, folder)
        finally:
            if browser:
                browser.close()
            server.terminate()
            server.communicate()
        check(server.returncode == 0, f"herr serve ended with {server.returncode}")
    print("page: numbers, pictures and charts change; no complaint")
    return 0


if __name__ == "__main__":
    sys.exit(main())
