# /// script
# dependencies = ["boto3==1.44.8", "moto[server]==5.2.5"]
# ///
"""A batch into the S3 of moto: the files of a local run, byte for byte."""

import os
import shutil
import subprocess

import boto3
from moto.server import ThreadedMotoServer
from support.checks import check, end, program, root, work

PLAN = """
scenes = ["demo-motorway.json"]
seeds = 4
chunk_units = 2
[generate]
horizon_s = 3
[[situations]]
template = "cut-in"
[[situations]]
template = "brake"
"""

server = ThreadedMotoServer(port=0)
server.start()
try:
    host, port = server.get_host_and_port()
    address = f"http://{host}:{port}"
    environment = {
        **os.environ,
        "AWS_ENDPOINT_URL": address,
        "AWS_ALLOW_HTTP": "true",
        "AWS_ACCESS_KEY_ID": "key",
        "AWS_SECRET_ACCESS_KEY": "secret",
        "AWS_REGION": "us-east-1",
    }

    def run(*arguments: str) -> str:
        made = subprocess.run([program, *arguments], capture_output=True, text=True, cwd=work, env=environment)
        check(f"{' '.join(arguments)}: {made.stderr[-500:]}", made.returncode == 0)
        return made.stdout

    store = boto3.client(
        "s3",
        endpoint_url=address,
        region_name="us-east-1",
        aws_access_key_id="key",
        aws_secret_access_key="secret",
    )
    store.create_bucket(Bucket="night")
    shutil.copy(root / "assets/scenes/demo-motorway.json", work)
    shutil.rmtree(work / "local", ignore_errors=True)
    (work / "plan.toml").write_text(PLAN)
    for place in ("local", "s3://night/out"):
        for shard in ("0/2", "1/2"):
            run("batch", "plan.toml", "-o", place, "--shard", shard)
        run("batch", "merge", place)
        run("batch", "report", place)
    files = [path for path in (work / "local").rglob("*") if path.is_file()]
    check("there are files", len(files) > 15)
    for path in files:
        name = path.relative_to(work / "local").as_posix()
        there = store.get_object(Bucket="night", Key=f"out/{name}")["Body"].read()
        check(f"equal: {name}", there == path.read_bytes())
    listed = store.list_objects_v2(Bucket="night")["Contents"]
    check("no other object", len(listed) == len(files))
    check("verified", "all equal" in run("batch", "verify", "s3://night/out"))
finally:
    server.stop()
end()
