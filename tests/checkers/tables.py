# /// script
# dependencies = ["pandas==3.1.1", "pyarrow==26.0.1"]
# ///
"""Tables of motion in pandas: columns and their types, order, and values equal to those of the scene."""

import json
import math
import subprocess

import pandas
import pyarrow.parquet
from support.checks import check, end, program, root, work

TEXT = ["scenario_id", "agent_id", "type", "subtype", "source"]
WHOLE = ["sample", "mode", "step"]
NUMBER = ["probability", "time_s", "x_m", "y_m", "z_m", "heading_rad", "vx_mps", "vy_mps"]
NUMBER += ["length_m", "width_m", "height_m"]
FLAG = ["valid", "chosen"]


def run(*arguments):
    subprocess.run([program, "-q", *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def near(a, b, most):
    return (math.isnan(a) and math.isnan(b)) or abs(a - b) <= most


def compare(name, frame, scene, most):
    origin = scene["meta"].get("origin", {})
    shift = origin.get("x_m", 0.0), origin.get("y_m", 0.0)
    log = frame[frame["source"] == "log"]
    for agent in scene["agents"]:
        own = log[log["agent_id"] == agent["id"]]
        track = agent["track"]
        first = track.get("first_step", 0)
        xs, ys, headings = track["x_m"], track["y_m"], track["heading_rad"]
        seen = own[own["valid"].astype(bool)]
        good = len(seen) > 0 and list(own["step"]) == sorted(own["step"])
        for row in seen.itertuples():
            i = int(row.step) - first
            good &= near(row.x_m, xs[i] + shift[0], most) and near(row.y_m, ys[i] + shift[1], most)
            turn = row.heading_rad - headings[i]
            good &= abs(math.atan2(math.sin(turn), math.cos(turn))) <= max(most, 1e-9)
            good &= near(row.time_s, row.step / 10, 1e-9)
        check(f"{name}: motion of {agent['id']}", good)
    futures = frame[frame["source"] == "generated"]
    samples = (scene.get("generated") or {}).get("samples", [])
    count = sum(len(m["x_m"]) for s in samples for a in s["agents"].values() for m in a["modes"])
    check(f"{name}: {count} rows of futures", len(futures) == count)
    for (sample, agent, mode), rows in futures.groupby(["sample", "agent_id", "mode"]):
        future = samples[int(sample)]["agents"][agent]["modes"][int(mode)]
        good = all(near(a, b + shift[0], most) for a, b in zip(rows["x_m"], future["x_m"]))
        good &= near(rows["probability"].iloc[0], future["probability"], max(most, 1e-9))
        check(f"{name}: future {sample}/{agent}/{mode}", good)


scenes = sorted((root / "assets/scenes").glob("*.json"))[:3]
for number, path in enumerate(scenes):
    generated = work / f"{path.stem}.json"
    if number == 0:
        run("generate", path, "--samples", "2", "--seed", "7", "--force", "-o", generated)
    else:
        generated.write_bytes(path.read_bytes())
    scene = json.loads(generated.read_text())
    for ending in ("csv", "parquet"):
        table = work / f"{path.stem}.{ending}"
        run("convert", generated, "--to", ending, "--force", "-o", table)
        if ending == "parquet":
            frame = pandas.read_parquet(table)
            types = {name: str(frame[name].dtype) for name in frame}
            check(f"{table.name}: texts", all(types[name] in ("str", "string", "object") for name in TEXT))
            check(f"{table.name}: numbers", all(types[name] == "float64" for name in NUMBER))
            check(f"{table.name}: flags", all(types[name] == "bool" for name in FLAG))
            check(f"{table.name}: steps", types["step"] == "int64")
            notes = pyarrow.parquet.read_metadata(table).metadata
            check(f"{table.name}: says its frame", b"dragtraffic" in notes and b"origin" in notes[b"dragtraffic"])
            check(f"{table.name}: no index", b"pandas" not in notes)
        else:
            frame = pandas.read_csv(table, dtype={name: "string" for name in TEXT})
        check(f"{table.name}: columns", set(frame.columns) == set(TEXT + WHOLE + NUMBER + FLAG))
        keys = frame.assign(g=frame["source"] == "generated")
        order = keys[["g", "sample", "step"]].fillna(-1)
        groups = (frame[["source", "sample", "agent_id", "mode"]].astype("string").fillna("") + "|").sum(axis=1)
        together = groups.ne(groups.shift()).fillna(True).sum() == groups.nunique()
        check(f"{table.name}: rows of one motion stand together", together)
        check(f"{table.name}: recorded rows first", order["g"].is_monotonic_increasing)
        compare(table.name, frame, scene, 1e-9 if ending == "parquet" else 1e-6)
        again = work / f"{path.stem}.{ending}.json"
        run("convert", table, "--force", "-o", again)
        check(f"{table.name}: comes back", len(json.loads(again.read_text())["agents"]) == len(scene["agents"]))

# A table that pandas writes, with another order of columns, codecs and encodings.
own = pandas.DataFrame(
    {
        "y_m": [0.0, 0.5, 1.0] * 2,
        "x_m": [0.0, 1.0, 2.0, 30.0, 31.0, 32.0],
        "time_s": [0.0, 0.1, 0.2] * 2,
        "agent_id": ["a"] * 3 + ["b"] * 3,
        "type": pandas.Categorical(["vehicle"] * 3 + ["pedestrian"] * 3),
    }
)
for codec in ("snappy", "zstd", "gzip", None):
    for version in ("1.0", "2.0"):
        table = work / f"pandas-{codec}-{version}.parquet"
        own.to_parquet(table, compression=codec, data_page_version=version)
        run("convert", table, "--force", "-o", work / "pandas.json")
        agents = json.loads((work / "pandas.json").read_text())["agents"]
        good = [agent["type"] for agent in agents] == ["vehicle", "pedestrian"]
        check(f"{table.name}: read", good and agents[1]["track"]["x_m"] == [30.0, 31.0, 32.0])
end()
