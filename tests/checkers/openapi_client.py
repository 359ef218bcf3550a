# /// script
# dependencies = ["openapi-python-client==0.29.1"]
# ///
"""A client that openapi-python-client generates from our OpenAPI document calls the server."""

import json
import os
import pathlib
import subprocess
import sys

from support.checks import check, end, program, root, work

# The package starts ruff by its name.
bin_folder = pathlib.Path(sys.executable).parent
environment = {**os.environ, "PATH": f"{bin_folder}{os.pathsep}{os.environ['PATH']}"}
made = subprocess.run(
    [bin_folder / "openapi-python-client", "generate", "--path", root / "assets/openapi.json"]
    + ["--output-path", work / "client", "--meta", "none", "--overwrite"],
    capture_output=True,
    text=True,
    env=environment,
)
told = made.stdout + made.stderr
check("generated", made.returncode == 0)
for complaint in ("WARNING", "Unable to"):
    check(f"no {complaint}: {told[-1500:]}", complaint not in told)

sys.path.insert(0, str(work))
from client import Client, models  # noqa: E402
from client.api.files import export_scene  # noqa: E402
from client.api.generate import generate, place  # noqa: E402
from client.api.maps import list_templates, make_map  # noqa: E402
from client.api.runs import begin_run, delete_run, peek_run, step_run  # noqa: E402
from client.api.scenes import create_scene, delete_scene, list_scenes, read_scene  # noqa: E402
from client.api.score import score  # noqa: E402
from client.api.server import healthz, info  # noqa: E402

command = [program, "serve", "--port", "0", "--db", work / "scenes.sqlite"]
server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
try:
    address = server.stdout.readline().split()[-1].rstrip("/")
    client = Client(base_url=address, timeout=120)
    document = json.loads((root / "assets/scenes/demo-crossing.json").read_text())
    scene = models.Scene.from_dict(document)
    check("a scene comes back as it was", scene.to_dict()["agents"] == document["agents"])
    check("health", healthz.sync(client=client).status == "ok")
    check("information", info.sync(client=client).version == "0.1.0")
    saved = create_scene.sync(client=client, body=scene)
    check("saved", isinstance(saved, models.Saved))
    check("listed", saved.id in [item.id for item in list_scenes.sync(client=client).scenes])
    check("read", len(read_scene.sync(saved.id, client=client).agents) == len(document["agents"]))
    asked = models.GenerateRequestType1.from_dict(
        {"scene_id": saved.id, "agents": ["5"], "conditions": {"5": {"goal": {"x_m": 14.0, "y_m": 0.4}}}}
    )
    answer = generate.sync(client=client, body=asked)
    check("futures", len(answer.samples[0].agents["5"].modes) == 6)
    about = models.PlaceBodyType1.from_dict({"scene_id": saved.id, "density": {"count": 5}, "keep": []})
    check("placed", len(place.sync(client=client, body=about).agents) == 5)
    scored = score.sync(client=client, body=models.ScoreRequestType1.from_dict({"scene_id": saved.id}))
    check("scored", len(scored.agents.to_dict()) == len(document["agents"]))
    # A reply in one of several media types: the client has no reader for it.
    wanted = export_scene._get_kwargs(saved.id, format_="csv")
    written = client.get_httpx_client().request(**wanted)
    check("exported", written.status_code == 200 and "csv" in written.headers["content-type"])
    check("templates", len(list_templates.sync(client=client).templates) > 5)
    drawn = make_map.sync(client=client, body=models.MapBody.from_dict({"template": "roundabout"}))
    check("a map", len(drawn.scene.map_.lanes) > 4)
    run = begin_run.sync(client=client, body=models.RunBodyType1.from_dict({"scene_id": saved.id}))
    step = step_run.sync(run.run, client=client, body=models.StepBody.from_dict({"number": 1}))
    check("a step", step.number == 1 and step.states.to_dict().keys() == run.present.states.to_dict().keys())
    peek = peek_run.sync(run.run, client=client, body=models.PeekBody.from_dict({"plans": {}}))
    check("a peek", len(peek.futures.to_dict()) > 0)
    check("a run ends", delete_run.sync_detailed(run.run, client=client).status_code == 204)
    check("deleted", delete_scene.sync_detailed(saved.id, client=client, if_match=saved.etag).status_code == 204)
    missing = read_scene.sync(saved.id, client=client)
    check("a problem has its code", missing.to_dict()["code"] == "not-found")
finally:
    server.terminate()
    server.wait()
end()
