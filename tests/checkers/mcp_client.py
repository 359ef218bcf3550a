# /// script
# requires-python = ">=3.10"
# dependencies = ["mcp==2.3.0", "pillow==13.0.0"]
# ///
"""The client of the Model Context Protocol's own Python package calls the tools of `dragtraffic mcp`."""

import asyncio
import base64
import io
import json

from mcp import ClientSession, StdioServerParameters, stdio_client
from PIL import Image
from support.checks import check, end, program, root, work

folder = work / "scenes"
folder.mkdir()
(folder / "crossing.json").write_bytes((root / "assets/scenes/demo-crossing.json").read_bytes())
(work / "outside.json").write_bytes((folder / "crossing.json").read_bytes())
(folder / "link.json").symlink_to(work / "outside.json")


def words(result):
    return result.content[0].text


def problem(result):
    data = result.structured_content
    return data["code"] if result.is_error and words(result).startswith(data["code"]) else None


def picture(result):
    """The picture of an answer, which is all that follows the words."""
    image = result.content[1]
    check("a PNG", image.mime_type == "image/png" and len(result.content) == 2)
    return Image.open(io.BytesIO(base64.b64decode(image.data))).convert("RGB")


def share_of(image, red, green, blue):
    pixels = list(image.get_flattened_data())
    near = [p for p in pixels if abs(p[0] - red) + abs(p[1] - green) + abs(p[2] - blue) < 30]
    return len(near) / len(pixels)


async def use(session):
    async def call(tool, /, **arguments):
        return await session.call_tool(tool, arguments)

    tools = {tool.name: tool for tool in (await session.list_tools()).tools}
    check(f"tools {sorted(tools)}", len(tools) == 12)
    check("descriptions", all(len(tool.description) > 40 and tool.title for tool in tools.values()))
    check("required arguments", tools["search_futures"].input_schema["required"] == ["scene", "where"])

    listed = words(await call("list_scenes"))
    check(listed, "demo-crossing" in listed and "crossing.json" in listed and "four-arms" in listed)
    check("links are not listed", "link.json" not in listed)

    opened = await call("open_scene", example="demo-crossing")
    check("opened", words(opened).startswith('Open as "demo-crossing".'))
    (folder / "opened.png").write_bytes(base64.b64decode(opened.content[1].data))
    shown = picture(opened)
    check("a picture of 800 pixels", shown.size == (800, 800))
    check("roads and vehicles in it", share_of(shown, 222, 225, 230) > 0.05 and share_of(shown, 56, 103, 214) > 0.0005)
    red = share_of(shown, 217, 45, 32)

    scene = json.loads((folder / "crossing.json").read_text())
    described = words(await call("describe_scene", scene="demo-crossing", most=100))
    present = described.split("Lanes (")[0].splitlines()
    for agent in scene["agents"]:
        track = agent["track"]
        if track["first_step"] == 0 and (track.get("valid") or [[0, 1]])[0][0] == 0:
            line = next((line for line in present if line.startswith(f"  {agent['id']}: ")), "")
            check(f"{agent['id']}: {line}", f"({track['x_m'][0]:.1f}, {track['y_m'][0]:.1f})" in line)
    check("lanes", f"Lanes ({len(scene['map']['lanes'])}):" in described)
    near = words(await call("describe_scene", scene="demo-crossing", road_user="5", most=5))
    check("near one", len(near) < len(described) and "  5: " in near)

    goal = {"5": {"frame": "agent", "goal": {"ahead_m": 30, "left_m": 0, "time_s": 6}}}
    told = await call("set_conditions", scene="demo-crossing", conditions=goal)
    check(words(told), "5 has its conditions" in words(told))
    check("a goal in the picture", share_of(picture(told), 0, 121, 76) > 0.00005)
    made = await call("generate_futures", scene="demo-crossing", agents=["5"], react=True, seed=3)
    check(words(made), not made.is_error and "5: goal m" in words(made) and "5 second by second: 1 s (" in words(made))
    check("a future in the picture", share_of(picture(made), 217, 45, 32) > red + 0.0001)
    await call("open_scene", example="demo-crossing", name="again")
    again = await call("generate_futures", scene="again", conditions=goal, agents=["5"], react=True, seed=3)
    check("equal calls give equal bytes", again.content == made.content)
    scored = words(await call("score_scene", scene="demo-crossing", road_user="5"))
    check("figures", "collisions = " in scored and "actor.min_distance_m = " in scored)

    searching = {"template": "brake", "where": "actor.min_ttc_s < 100", "seeds": 3}
    found = words(await call("search_futures", scene="demo-crossing", **searching))
    check(found, "seeds hold actor.min_ttc_s < 100" in found and "The scene keeps the result of seed" in found)

    exported = await call("export_scene", scene="demo-crossing", format="csv", file="out.csv")
    check(words(exported), (folder / "out.csv").read_text().count("\n") > 100)
    kept = await call("export_scene", scene="demo-crossing", format="csv", file="out.csv")
    check("a file is not replaced", problem(kept) == "exists")
    written = await call("export_scene", scene="demo-crossing", format="dragtraffic", file="out.json")
    check("written as a scene", "generated" in json.loads((folder / "out.json").read_text()) and not written.is_error)
    reopened = await call("open_scene", file="out.json", name="mine", picture=False)
    check("opened again", words(reopened).startswith('Open as "mine"') and len(reopened.content) == 1)
    long = await call("export_scene", scene="mine", format="dragtraffic")
    check("too long for an answer", problem(long) == "reply-too-large")

    drawn = await call("draw_map", template="roundabout", picture=False)
    check(words(drawn), words(drawn).startswith('Open as "roundabout"'))
    placed = await call("place_road_users", scene="roundabout", density={"count": 8}, seed=1)
    check(words(placed), words(placed).startswith("Placed 8 road users"))
    close = await call("picture", scene="roundabout", x_m=0, y_m=0, width_m=40)
    check("a picture of a place", picture(close).size == (800, 800))
    check("closed", not (await call("close_scene", scene="roundabout")).is_error)

    refusals = [
        ("not-found", "describe_scene", {"scene": "roundabout"}),
        ("not-found", "open_scene", {"file": "../outside.json"}),
        ("not-found", "open_scene", {"file": str(work / "outside.json")}),
        ("not-found", "open_scene", {"file": "link.json"}),
        ("not-found", "export_scene", {"scene": "mine", "format": "csv", "file": "../out.csv"}),
        ("unknown-agent", "generate_futures", {"scene": "mine", "agents": ["nobody"]}),
        ("out-of-range", "generate_futures", {"scene": "mine", "horizon_s": 1e9}),
        ("invalid-field", "generate_futures", {"scene": "mine", "wish": 1}),
        ("invalid-field", "search_futures", {"scene": "mine", "where": "min_tcc_s < 1"}),
        ("format-unknown", "export_scene", {"scene": "mine", "format": "jpeg"}),
    ]
    for code, name, arguments in refusals:
        refused = await call(name, **arguments)
        check(f"{name} {arguments}: {words(refused)}", problem(refused) == code)
    check("nothing was written outside", not (work / "out.csv").exists())


async def main():
    parameters = StdioServerParameters(command=program, args=["mcp", "--folder", str(folder)])
    async with stdio_client(parameters) as streams, ClientSession(*streams) as session:
        started = await session.initialize()
        check("the server names itself", started.server_info.name == "dragtraffic")
        check("instructions", "open_scene" in started.instructions)
        await use(session)


asyncio.run(main())
end()
