# /// script
# dependencies = ["geojson-pydantic==2.2.0"]
# ///
"""Collections in geojson-pydantic, and the right-hand rule of RFC 7946 for rings."""

import json
import subprocess

from geojson_pydantic import FeatureCollection
from support.checks import check, end, program, root, work


def area(ring):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:])) / 2


for path in sorted((root / "assets/scenes").glob("*.json"))[:4]:
    source = work / path.name
    subprocess.run([program, "-q", "generate", path, "--samples", "2", "--force", "-o", source], check=True)
    made = work / f"{path.stem}.geojson"
    subprocess.run([program, "-q", "convert", source, "--to", "geojson", "--force", "-o", made], check=True)
    scene, text = json.loads(source.read_text()), made.read_text()
    collection = FeatureCollection.model_validate_json(text)
    kinds = {}
    for feature in collection.features:
        kinds.setdefault(feature.properties["kind"], []).append(feature)
    check(f"{path.name}: lanes", len(kinds.get("lane", [])) == len(scene["map"]["lanes"]))
    check(f"{path.name}: tracks", len(kinds.get("track", [])) == len(scene["agents"]))
    futures = sum(len(a["modes"]) for s in scene["generated"]["samples"] for a in s["agents"].values())
    check(f"{path.name}: futures", len(kinds.get("future", [])) == futures)
    ids = [feature.id for feature in collection.features]
    check(f"{path.name}: ids", len(set(ids)) == len(ids))
    polygons = [f.geometry for f in collection.features if f.geometry and f.geometry.type == "Polygon"]
    for polygon in polygons:
        outer, *holes = polygon.coordinates
        closed = all(ring[0] == ring[-1] and len(ring) > 3 for ring in polygon.coordinates)
        check(f"{path.name}: rings", closed and area(outer) >= 0 and all(area(hole) <= 0 for hole in holes))
    frame = json.loads(text)["frame"]
    check(f"{path.name}: frame", frame["kind"] in ("local", "projected") and len(frame["origin_m"]) == 2)
end()
