"""The server and nginx of docs/hosting.md, with TLS: what a browser does through both."""

import base64
import contextlib
import http.client
import json
import os
import socket
import ssl
import struct
import subprocess
import time

from support.checks import check, program, root, work

HOST, BASE = "scenes.example", "/tools/drag"
TOKEN = "5f0c1a9be2d84763a1c97e20f4b8d315"
ASKED = {"scene_id": "demo-crossing", "agents": ["4"], "seed": 7}


def free_port():
    with socket.socket() as held:
        held.bind(("127.0.0.1", 0))
        return held.getsockname()[1]


@contextlib.contextmanager
def running(command, **options):
    started = subprocess.Popen([str(part) for part in command], stdout=subprocess.DEVNULL, **options)
    try:
        yield started
    finally:
        started.terminate()
        started.wait(timeout=30)


class Browser:
    """Calls by TLS, with the name of the site."""

    def __init__(self, port, certificate):
        self.port, self.context = port, ssl.create_default_context(cafile=certificate)

    def line(self):
        plain = socket.create_connection(("127.0.0.1", self.port), timeout=60)
        return self.context.wrap_socket(plain, server_hostname=HOST)

    def call(self, method, path, body=None, **headers):
        connection = http.client.HTTPSConnection(HOST, timeout=60)
        connection.sock = self.line()
        connection.request(method, BASE + path, body, headers)
        reply = connection.getresponse()
        return reply.status, reply.headers, reply.read()


def events_of_a_websocket(browser, cookie):
    """Names of the events that an open line brings for one question."""
    key = base64.b64encode(os.urandom(16)).decode()
    head = {"Host": HOST, "Origin": f"https://{HOST}", "Cookie": cookie, "Connection": "Upgrade"}
    head |= {"Upgrade": "websocket", "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": key}
    fields = "".join(f"{name}: {value}\r\n" for name, value in head.items())
    question = json.dumps({"ask": 1, "body": ASKED}).encode()
    mask = os.urandom(4)
    masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(question))
    names = []
    with browser.line() as line, line.makefile("rb") as replies:
        line.sendall(f"GET {BASE}/v1/generate HTTP/1.1\r\n{fields}\r\n".encode())
        status = replies.readline().split()[1]
        while replies.readline() not in (b"\r\n", b""):
            pass
        if status != b"101":
            return [f"status {status.decode()}"]
        assert len(question) < 126
        line.sendall(bytes([0x81, 0x80 | len(question)]) + mask + masked)
        message = b""
        while "final" not in names:
            kind, length = replies.read(2)
            if length >= 126:
                size, form = (2, ">H") if length == 126 else (8, ">Q")
                length = struct.unpack(form, replies.read(size))[0]
            part = replies.read(length)
            if kind & 0x0F == 8:
                break
            # Pings have a kind of their own; a long message comes in several parts, the last of which is marked.
            message += part if kind & 0x0F in (0, 1) else b""
            if kind & 0x80 and message:
                names += [json.loads(event)["event"] for event in message.decode().strip().split("\n")[1:]]
                message = b""
    return names


def through_both(nginx, configuration, options, site, certificate, environment):
    """Starts both and does what a browser does."""
    port, probes = free_port(), free_port()
    (work / "proxied.toml").write_text(options.replace("127.0.0.1:9090", f"127.0.0.1:{probes}"))
    site = site.replace("listen 443 ssl;", f"listen 127.0.0.1:{port} ssl;")
    user = "user root;\n" if os.geteuid() == 0 else ""
    (work / "proxied.conf").write_text(f"{user}daemon off;\n{configuration}\n{site}}}\n")
    browser = Browser(port, certificate)
    server = [program, "serve", "--config", work / "proxied.toml"]
    proxy = [nginx, "-p", work, "-e", work / "error.log", "-c", work / "proxied.conf"]
    quiet = {"stderr": subprocess.DEVNULL, "cwd": root, "env": environment}
    with running(server, **quiet), running(proxy, **quiet):
        for _ in range(300):
            with contextlib.suppress(OSError):
                if browser.call("GET", "/v1/info", Authorization=f"Bearer {TOKEN}")[0] == 200:
                    break
            time.sleep(0.1)
        status, _, page = browser.call("GET", "/")
        check("a page asks for the token", status == 401 and b"This server needs a token" in page)
        head = {"Origin": f"https://{HOST}", "Content-Type": "application/x-www-form-urlencoded"}
        status, fields, _ = browser.call("POST", "/", f"token={TOKEN}", **head)
        cookie, *traits = (fields["Set-Cookie"] or "").split("; ")
        check("the form leads to the editor", (status, fields["Location"]) == (303, f"{BASE}/"))
        wanted = {f"Path={BASE}/", "HttpOnly", "SameSite=Strict", "Secure"}
        check(f"the cookie is for this path and TLS alone: {traits}", wanted <= set(traits))
        status, _, page = browser.call("GET", "/", Cookie=cookie)
        check("the cookie opens the editor", status == 200 and b"This server needs a token" not in page)
        head = {"Origin": f"https://{HOST}", "Content-Type": "application/json", "Cookie": cookie}
        asked = json.dumps(ASKED)
        status, _, text = browser.call("POST", "/v1/generate", asked, **head, Accept="text/event-stream")
        check("events stream", status == 200 and b"event: step" in text and b"event: final" in text)
        names = events_of_a_websocket(browser, cookie)
        check(f"a WebSocket brings futures: {names}", names[-1:] == ["final"])
        check("one without cookie is refused", events_of_a_websocket(browser, "a=b") == ["status 401"])
        scene = (root / "assets/scenes/demo-crossing.json").read_bytes()
        check("a scene is saved", browser.call("POST", "/v1/scenes", scene, **head)[0] == 201)
        probe = http.client.HTTPConnection("127.0.0.1", probes, timeout=10)
        probe.request("GET", "/readyz")
        check("the probes answer", probe.getresponse().status == 200)
