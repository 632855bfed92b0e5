"""Worlds, lamps, nodes and scenes that go, come and are shared: cases of misuse_steps."""

import math

import addon_utils
import bpy
from misuse_steps import case, environment, quick
from steps import error_of, part, pixels_of

RENDERED = "probe of 64 x 32 pixels"


def _mean(scene):
    return float(pixels_of(environment(scene.world).image).mean())


def _sun(scene):
    (lamp,) = [thing for thing in scene.objects if thing.type == "LIGHT"]
    return lamp


def _follow(stage, **settings):
    """Change settings and bring the preview up to date, which the interface does by itself; the scene is lit then, by one Sun."""
    stage.set(**settings)
    part("live").update_now(stage.scene, final=False)
    assert part("scene_probe").is_lit(stage.scene) and _mean(stage.scene) > 0.0
    _sun(stage.scene)


@case(RENDERED)
def deleted_world(stage):
    """The world of the sky is deleted."""
    stage.add()
    stage.unmark()
    bpy.data.worlds.remove(stage.scene.world)
    stage.settings.north = 1.0
    assert not part("scene_probe").is_lit(stage.scene)
    stage.scene.world = bpy.data.worlds["Mine"]
    return stage.render()


@case(RENDERED)
def deleted_old_world(stage):
    """The world that the scene had before is deleted."""
    stage.add()
    stage.unmark()
    bpy.data.worlds.remove(bpy.data.worlds["Mine"])
    return stage.render()


@case("lit")
def deleted_images(stage):
    """The picture of the rendered probe is deleted, then that of the preview."""
    stage.unmark()
    stage.render()
    bpy.data.images.remove(stage.settings.image)
    _follow(stage)
    bpy.data.images.remove(environment(stage.scene.world).image)
    _follow(stage, hour=10.0)
    return "lit"


@case("lit")
def deleted_lamp(stage):
    """The Sun is deleted as with the X key, then its light."""
    stage.add()
    stage.unmark()
    with bpy.context.temp_override(selected_objects=[_sun(stage.scene)]):
        bpy.ops.object.delete()
    _follow(stage, hour=10.0)
    bpy.data.lights.remove(_sun(stage.scene).data)
    stage.settings.north = 1.0
    _follow(stage, hour=11.0)
    return "lit"


@case("lit")
def lamp_of_another_kind(stage):
    """The Sun was made a point light, which has no angle."""
    stage.add()
    stage.unmark()
    _sun(stage.scene).data.type = "POINT"
    _follow(stage, hour=10.0)
    assert _sun(stage.scene).data.type == "SUN"
    return "lit"


@case("lit")
def deleted_nodes(stage):
    """All nodes of the world are deleted, and north is turned."""
    stage.add()
    stage.unmark()
    stage.scene.world.node_tree.nodes.clear()
    stage.settings.north = 1.0
    _follow(stage, hour=10.0)
    assert math.isclose(stage.scene.world.node_tree.nodes["Skyprobe North"].inputs["Rotation"].default_value[2], 1.0)
    return "lit"


@case("lit")
def nodes_of_another_kind(stage):
    """Nodes of the user's have the names of ours."""
    stage.add()
    stage.unmark()
    nodes = stage.scene.world.node_tree.nodes
    for name in ("Skyprobe North", "Skyprobe Environment"):
        nodes.remove(nodes[name])
        nodes.new("ShaderNodeMath").name = name
    stage.settings.north = 1.0
    _follow(stage, hour=10.0)
    assert len([node for node in nodes if node.bl_idname == "ShaderNodeMath"]) == 2
    return "lit"


@case("lit")
def nodes_switched_off(stage):
    """The world does not use its nodes."""
    stage.add()
    stage.unmark()
    if bpy.app.version < (5, 0, 0):
        stage.scene.world.use_nodes = False
    _follow(stage, hour=10.0)
    assert bpy.app.version >= (5, 0, 0) or stage.scene.world.use_nodes
    return "lit"


@case("the user's")
def world_replaced(stage):
    """The user gives the scene another world; the sky is neither forced upon it nor left behind."""
    stage.add()
    stage.unmark()
    mine = bpy.data.worlds.new("Another")
    stage.scene.world = mine
    stage.set(hour=10.0, north=1.0)
    stage.scene.frame_set(3)
    assert stage.scene.world == mine and (mine.node_tree is None or "Skyprobe North" not in mine.node_tree.nodes)
    bpy.ops.skyprobe.remove()
    assert stage.scene.world == mine
    return "the user's"


@case("kept")
def worlds_with_fake_users(stage):
    """Both worlds have a fake user: the old one comes back, the other stays because the user wants that."""
    mine = stage.scene.world
    mine.use_fake_user = True
    bpy.ops.skyprobe.add()
    stage.unmark()
    sky = stage.scene.world
    assert not sky.use_fake_user
    sky.use_fake_user = True
    bpy.ops.skyprobe.remove()
    assert stage.scene.world == mine and mine.use_fake_user and sky.name in bpy.data.worlds
    picture = environment(sky).image
    bpy.data.worlds.remove(sky)
    bpy.data.images.remove(picture)
    return "kept"


@case("the other's stays")
def world_of_two_scenes(stage):
    """Two scenes have the same world, and one gets a sky."""
    other = bpy.data.scenes.new("Other")
    other.world = stage.scene.world
    stage.add()
    stage.unmark()
    assert other.world == bpy.data.worlds["Mine"] != stage.scene.world
    return "the other's stays"


def _copied(stage, kind):
    """Copy the lit scene; return both, the copy in the window."""
    stage.add()
    stage.render()
    stage.unmark()
    first = stage.scene
    bpy.ops.scene.new(type=kind)
    return first, stage.scene


def _each_changes(stage, kind):
    first, second = _copied(stage, kind)
    before = [_mean(first), tuple(_sun(first).rotation_euler)]
    stage.settings.north = 1.0
    _follow(stage, hour=20.0)
    assert first.world != second.world and _sun(first) != _sun(second) and _sun(first).data != _sun(second).data
    assert before == [_mean(first), tuple(_sun(first).rotation_euler)]
    after = [_mean(second), tuple(_sun(second).rotation_euler)]
    bpy.context.window.scene = first
    _follow(stage, hour=8.0)
    assert after == [_mean(second), tuple(_sun(second).rotation_euler)]
    bpy.ops.skyprobe.remove()
    assert after == [_mean(second), tuple(_sun(second).rotation_euler)]
    return "each its own"


@case("each its own")
def linked_copy_of_a_scene(stage):
    """A linked copy begins with the same world, lamp and pictures; both change."""
    return _each_changes(stage, "LINK_COPY")


@case("each its own")
def full_copy_of_a_scene(stage):
    """A full copy begins with the same pictures; both change."""
    return _each_changes(stage, "FULL_COPY")


@case("the first's stays")
def copy_of_a_scene_removed(stage):
    """The sky of a linked copy is removed before it ever changed."""
    first, second = _copied(stage, "LINK_COPY")
    before = [_mean(first), _sun(first).name, first.world.name]
    bpy.ops.skyprobe.remove()
    assert before == [_mean(first), _sun(first).name, first.world.name]
    assert second.world == bpy.data.worlds["Mine"] and not [thing for thing in second.objects if thing.type == "LIGHT"]
    bpy.context.window.scene = first
    bpy.data.scenes.remove(second)
    return "the first's stays"


@case("one Sun each")
def lamp_in_a_shared_collection(stage):
    """The Sun was moved into a collection that a linked copy shows too: it must not shine twice there."""
    stage.add()
    stage.unmark()
    shared = bpy.data.collections.new("Lights")
    stage.scene.collection.children.link(shared)
    lamp = _sun(stage.scene)
    shared.objects.link(lamp)
    stage.scene.collection.objects.unlink(lamp)
    first = stage.scene
    bpy.ops.scene.new(type="LINK_COPY")
    _follow(stage, hour=10.0)
    assert _sun(first) != _sun(stage.scene)
    return "one Sun each"


@case("turned")
def north_of_an_animated_lamp(stage):
    """North is turned while a finished sequence plays: the Sun turns with the map."""
    stage.unmark()
    stage.set(sequence_directory=str(stage.folder))
    stage.scene.frame_end = 2
    bpy.ops.skyprobe.render_sequence()
    before = _sun(stage.scene).rotation_euler.z
    stage.settings.north = 1.0
    for frame in (1, 2):
        stage.scene.frame_set(frame)
        assert math.isclose(_sun(stage.scene).rotation_euler.z, before - 1.0, abs_tol=1e-5)
    bpy.ops.skyprobe.leave_sequence()
    assert stage.settings.shown == "PREVIEW"
    return "turned"


def _library(stage):
    """Write the lit scene to a file of its own, and begin another."""
    stage.add()
    path = str(stage.folder / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    bpy.ops.wm.read_homefile(use_empty=True)
    stage.unmark()
    quick(stage.scene)
    return path


@case(RENDERED)
def linked_world(stage):
    """The scene's world comes from another file, and was a sky there."""
    path = _library(stage)
    with bpy.data.libraries.load(path, link=True) as (there, here):
        here.worlds = ["Skyprobe"]
    stage.scene.world = linked = here.worlds[0]
    error = stage.render()
    assert stage.scene.world != linked and stage.scene.world.library is None and linked.library is not None
    bpy.ops.skyprobe.remove()
    assert stage.scene.world == linked
    return error


@case("The scene is linked from another file: open that file, or make it local")
def linked_scene(stage):
    """The whole scene comes from another file."""
    path = _library(stage)
    here = stage.scene
    with bpy.data.libraries.load(path, link=True) as (there, found):
        found.scenes = ["Scene"]
    (linked,) = found.scenes
    bpy.context.window.scene = linked
    messages = {error_of(operator) for operator in (bpy.ops.skyprobe.add, bpy.ops.skyprobe.render, bpy.ops.skyprobe.remove, bpy.ops.skyprobe.reset)}
    linked.frame_set(5)
    bpy.context.window.scene = here
    (message,) = {message.split("poll() ")[-1] for message in messages}
    return message


@case(RENDERED)
def nothing_in_the_scene(stage):
    """No world, no camera, no object, none active."""
    stage.scene.world = None
    stage.unmark()
    assert bpy.context.view_layer.objects.active is None and stage.scene.camera is None
    return stage.render()


@case(RENDERED)
def eevee_alone(stage):
    """Cycles is switched off, and EEVEE renders."""
    stage.unmark()
    stage.scene.render.engine = "BLENDER_EEVEE_NEXT" if bpy.app.version < (5, 0, 0) else "BLENDER_EEVEE"
    addon_utils.disable("cycles")
    try:
        assert not hasattr(stage.scene.world, "cycles")
        error = stage.render(sun_mode="MAP")
        assert stage.scene.world.sun_threshold > 0.0
    finally:
        addon_utils.enable("cycles")
    return error


@case("lit")
def undo_and_redo(stage):
    """Add, change, undo twice, redo twice: the sky is that of the settings each time."""
    stage.unmark()
    bpy.ops.ed.undo_push(message="empty")
    bpy.ops.skyprobe.add()
    bpy.ops.ed.undo_push(message="added")
    noon = _mean(stage.scene)
    _follow(stage, hour=20.0)
    bpy.ops.ed.undo_push(message="evening")
    evening = _mean(stage.scene)
    bpy.ops.ed.undo()
    assert math.isclose(_mean(stage.scene), noon, rel_tol=1e-5) and stage.settings.hour == 13.0
    bpy.ops.ed.undo()
    assert not part("scene_probe").is_lit(stage.scene) and stage.scene.world.name == "Mine"
    bpy.ops.ed.redo()
    bpy.ops.ed.redo()
    assert math.isclose(_mean(stage.scene), evening, rel_tol=1e-5) and stage.settings.hour == 20.0
    bpy.ops.skyprobe.remove()
    return "lit"


@case("probe of 64 x 32 pixels")
def result_that_someone_wrote(stage):
    """A script damages what is kept of the rendered probe."""
    stage.unmark()
    stage.render()
    stage.settings.image_result = '{"sun": 3}'
    _follow(stage, hour=10.0)
    stage.set(hour=13.0)
    return stage.message() or stage.render()
