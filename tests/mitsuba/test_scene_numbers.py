"""The XML for Mitsuba and tests/scene.json, from which the Blender scene is built, describe one scene."""

import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
import render_scene

XML = ElementTree.parse(render_scene.SCENE_XML).getroot()
DEFAULTS = {node.get("name"): node.get("value") for node in XML.iter("default")}


def numbers(text):
    return [float(part) for part in text.split(",")]


def element(identifier):
    found = [node for node in XML if node.get("id") == identifier]
    assert len(found) == 1, identifier
    return found[0]


def value(node, name):
    """The number or numbers of the parameter `name` of a node, defaults filled in."""
    found = [child for child in node.iter() if child.get("name") == name and child.get("value") is not None]
    assert len(found) == 1, name
    text = found[0].get("value")
    return numbers(DEFAULTS[text[1:]] if text.startswith("$") else text)


def box_of(identifier):
    """Smallest and largest corner of a shape as Mitsuba built it."""
    import mitsuba as mi

    mi.set_variant("scalar_rgb")
    shapes = {shape.id(): shape for shape in mi.load_dict({"type": "scene", **parsed_shapes()}).shapes()}
    bounds = shapes[identifier].bbox()
    return np.array(bounds.min), np.array(bounds.max)


def parsed_shapes():
    """The shapes of the XML without its light, so that no probe is needed."""
    import mitsuba as mi

    kept = ElementTree.Element("scene", version=XML.get("version"))
    kept.extend(node for node in XML if node.tag in ("bsdf", "shape"))
    loaded = mi.load_string(ElementTree.tostring(kept, encoding="unicode"), optimize=False)
    return {shape.id(): shape for shape in loaded.shapes()}


@pytest.mark.parametrize("name", ["plane", "pole", "pole_cap", "box", "metal_sphere", "glass_sphere"])
def test_every_shape_has_its_place_and_size(scene, name):
    low, high = box_of(name)
    thing = scene["pole" if name == "pole_cap" else name]
    if name == "plane":
        centre, half = np.array(thing["centre"]), np.array([thing["size"] / 2, thing["size"] / 2, 0.0])
    elif name == "pole":
        centre = np.array(thing["base"]) + [0.0, 0.0, thing["height"] / 2]
        half = np.array([thing["radius"], thing["radius"], thing["height"] / 2])
    elif name == "pole_cap":
        centre = np.array(thing["base"]) + [0.0, 0.0, thing["height"]]
        half = np.array([thing["radius"], thing["radius"], 0.0])
    elif name == "box":
        centre, half = np.array(thing["centre"]), np.array(thing["size"]) / 2
    else:
        centre, half = np.array(thing["centre"]), np.full(3, thing["radius"])
    np.testing.assert_allclose(low, centre - half, atol=1e-5)
    np.testing.assert_allclose(high, centre + half, atol=1e-5)


def test_the_xml_has_no_other_shape(scene):
    shapes = {node.get("id") for node in XML.iter("shape")}
    described = {name for name, thing in scene.items() if isinstance(thing, dict) and "material" in thing}
    assert shapes == described | {"pole_cap"}


@pytest.mark.parametrize("name", ["white", "grey", "red", "rough_metal", "glass"])
def test_every_material_is_the_same(scene, name):
    node, material = element(name), scene["materials"][name]
    if material["type"] == "diffuse":
        inner = node.find("bsdf") if node.get("type") == "twosided" else node
        assert inner.get("type") == "diffuse"
        assert value(node, "reflectance") == material["reflectance"]
    elif material["type"] == "rough_conductor":
        assert node.get("type") == "roughconductor"
        assert value(node, "specular_reflectance") == material["reflectance"]
        assert value(node, "alpha") == [material["alpha"]]
        distribution = [child.get("value") for child in node if child.get("name") == "distribution"]
        assert distribution == [material["distribution"]]
    else:
        assert (node.get("type"), material["type"]) == ("dielectric", "dielectric")
        assert value(node, "int_ior")[0] / value(node, "ext_ior")[0] == material["ior"]


def test_every_shape_has_its_material(scene):
    for node in XML.iter("shape"):
        name = "pole" if node.get("id") == "pole_cap" else node.get("id")
        assert [reference.get("id") for reference in node.iter("ref")] == [scene[name]["material"]]


def test_the_camera_is_the_same(scene):
    camera, sensor = scene["camera"], element("camera")
    look = next(sensor.iter("lookat"))
    for name in ("origin", "target", "up"):
        assert numbers(look.get(name)) == camera[name]
    assert sensor.get("type") == camera["type"]
    assert value(sensor, "fov") == [camera["horizontal_fov_deg"]]
    width, height = camera["resolution"]
    assert value(sensor, "width")[0] / value(sensor, "height")[0] == width / height


def test_the_paths_are_equally_long(scene):
    assert int(DEFAULTS["max_depth"]) == scene["max_bounces"] + 2
