# /// script
# dependencies = []
# ///
"""A client of openapi-fetch, over the types that openapi-typescript makes of our OpenAPI document, calls the server. The
compiler judges the calls: a reply that the document does not describe has no fields."""

import pathlib
import shutil
import subprocess

from support.checks import check, end, program, root, work

PACKAGES = ["openapi-typescript@7.13.0", "openapi-fetch@0.17.0", "typescript@5.9.3"]
here = pathlib.Path(__file__).parent / "support"


def run(*command):
    ran = subprocess.run([str(part) for part in command], cwd=work, capture_output=True, text=True, timeout=300)
    return ran.returncode, ran.stdout + ran.stderr


npm, node = shutil.which("npm"), shutil.which("node")
if not (npm and node):
    print("npm is not installed")
    end()
(work / "package.json").write_text('{"type": "module", "private": true}')
code, told = run(npm, "install", "--no-audit", "--no-fund", "--ignore-scripts", *PACKAGES)
if code:
    print(f"the packages cannot be had: {told[-500:]}")
    end()
tools = work / "node_modules/.bin"
# By itself it takes a member with a default for one that each request must have.
made = [tools / "openapi-typescript", root / "assets/openapi.json", "--output", "api.d.ts"]
code, told = run(*made, "--default-non-nullable=false")
check(f"generated\n{told[-2000:]}", code == 0)
(work / "client.ts").write_text((here / "client.ts").read_text())
compile = ["--strict", "--target", "es2022", "--module", "nodenext", "--skipLibCheck", "--lib", "es2023,dom"]
code, told = run(tools / "tsc", *compile, "client.ts")
check(f"the compiler takes the calls\n{told[-2000:]}", code == 0)
(work / "wrong.ts").write_text((here / "client.ts").read_text().replace("answer.samples", "answer.sample"))
check("the compiler refuses a field that no reply has", run(tools / "tsc", *compile, "--noEmit", "wrong.ts")[0] != 0)

command = [program, "serve", "--port", "0", "--db", work / "scenes.sqlite"]
server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
try:
    address = server.stdout.readline().split()[-1]
    code, told = run(node, "client.js", address, root / "assets/scenes/demo-crossing.json")
    for line in told.splitlines():
        verdict, _, name = line.partition(" ")
        check(name, verdict == "ok")
    check(f"the client ended well\n{told[-2000:]}", code == 0 and told.count("ok ") >= 10)
finally:
    server.terminate()
    server.wait()
end()
