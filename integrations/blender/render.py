"""Renders the pictures of a parity contract by Blender, without a window. See README.md, and kUsage below."""
import argparse
import contextlib
import json
import math
import os
import sys
import time

import bpy
from mathutils import Matrix, Vector

kUsage = "blender -b --factory-startup --python render.py -- CONTRACT SHOTS [--scene NAME] [--engine cycles|eevee] [--samples N]"

try:
    import numpy
except ImportError:  # Blender itself would end with 0
    print(f"render.py: {sys.prefix}: the Python that Blender uses has no numpy, which its glTF importer needs", file=sys.stderr)
    sys.exit(1)

# glTF has +Y up and Blender +Z: Blender's importer puts (x, y, z) at (x, -z, y), and so do we with cameras and lights.
# The contract's map needs no rotation: Cycles reads the column u = .5 - atan2(Y, X) / (2 pi) of an equirectangular map
# (direction_to_equirectangular in intern/cycles/kernel/camera/projection.h), with (X, Y) = (x, -z) that is the contract's
# u = .5 + atan2(z, x) / (2 pi).
kToBlender = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))

# Debian 12 has Blender 3.4, whose importer says numpy.bool, with numpy 1.24, which has no such name any more.
if "bool" not in vars(numpy):
    numpy.bool = bool


class Refused(Exception):
    """What the user can mend: file and reason, in one line."""


def readOptions():
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="render.py", usage=kUsage, allow_abbrev=False)
    parser.add_argument("contract", metavar="CONTRACT", help="the folder that 'parity contract' wrote")
    parser.add_argument("shots", metavar="SHOTS", help="the folder for the pictures, made where it is missing")
    parser.add_argument("--scene", metavar="NAME", help="this scene only, and the calibration")
    parser.add_argument("--engine", choices=["cycles", "eevee"], default="cycles", help="cycles is the default; eevee needs a display")
    parser.add_argument("--samples", type=int, default=256, metavar="N", help="samples of a pixel (256), whatever the contract says")
    options = parser.parse_args(words)
    if options.samples < 1:
        parser.error("--samples must be at least 1")
    return options


def readContract(folder, onlyScene):
    file = os.path.join(folder, "contract.json")
    try:
        with open(file, encoding="utf-8") as stream:
            contract = json.load(stream)
    except (OSError, ValueError) as error:
        raise Refused(f"{file}: {getattr(error, 'strerror', None) or error}") from None
    if contract.get("format") != 1:
        raise Refused(f"{file}: its format is {contract.get('format')}, this adapter reads 1")
    scenes = [each for each in contract.get("scenes", []) if onlyScene in (None, each["name"])]
    if not scenes:
        raise Refused(f"{file}: it has no scene {onlyScene}" if onlyScene else f"{file}: it has no scenes")
    if contract.get("calibration"):
        scenes.insert(0, {"name": "calibration", **contract["calibration"]})
    for scene in scenes:
        files = [scene["scene"]] + ([scene["environment"]["file"]] if scene.get("environment") else [])
        for each in files:
            if not os.path.isfile(os.path.join(folder, each)):
                raise Refused(f"{file}: scene {scene['name']}: there is no {each}")
        for view in scene["views"]:
            if os.path.basename(view["picture"]) != view["picture"] or not view["picture"].endswith(".png"):
                raise Refused(f"{file}: {view['picture']} is not the name of a picture")
            if view["transfer"] != "srgb":
                raise Refused(f"{file}: {view['picture']}: the transfer {view['transfer']} is not known")
    return scenes


@contextlib.contextmanager
def quiet():
    """Blender prints its progress, and traces of errors that we tell in a line, from C."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept = [os.dup(1), os.dup(2)]
    nothing = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)
    try:
        yield
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        for to, each in enumerate(kept, 1):
            os.dup2(each, to)
            os.close(each)
        os.close(nothing)


def loadModel(file):
    try:
        bpy.ops.import_scene.gltf(filepath=file)
    except RuntimeError as error:
        reason = [line for line in str(error).splitlines() if line.strip() and not line.startswith("Location:")][-1]
        raise Refused(f"{file}: {reason.strip()}") from None
    for node in [each for each in bpy.data.objects if each.type in ("LIGHT", "CAMERA")]:
        bpy.data.objects.remove(node)  # the contract lists the lights, too
    for image in bpy.data.images:
        # The importer goes on without a texture that it cannot read. Its picture would be compared as if it were right.
        if image.source == "FILE" and not (image.size[0] and image.size[1]):
            raise Refused(f"{file}: the texture {image.filepath or image.name} cannot be read")


def addLight(light):
    """Cycles has no photometric units: one unit of light is one unit, in the map and here, whatever it is called.
    Sun: `energy` is the irradiance E of a surface that faces it (W/m^2), so E = lux.
    Point and spot: `energy` is the power P of a light that shines in all directions alike, I = P / (4 pi), so P = 4 pi candela;
    a spot is the same light behind a mask. (Blender's manual, Light Objects, "Power of Lights"; the importer's mode COMPAT.)"""
    kind = {"directional": "SUN", "point": "POINT", "spot": "SPOT"}.get(light["kind"])
    if kind is None:
        raise Refused(f"light {light['name']}: the kind {light['kind']} is not known")
    if light.get("falloff", "khr") != "khr":
        raise Refused(f"light {light['name']}: the falloff {light['falloff']} is not known")
    data = bpy.data.lights.new(light["name"], kind)
    intensity = max(light["color"])
    data.color = [each / intensity for each in light["color"]] if intensity > 0 else (0, 0, 0)
    data.energy = intensity * (1 if kind == "SUN" else 4 * math.pi)
    if kind == "SUN":
        data.angle = 0
    else:
        data.shadow_soft_size = 0
    if kind == "SPOT":
        # Cycles fades by smoothstep from cos(outer) to cos(outer) + (1 - cos(outer)) spot_blend.
        outer, inner = math.cos(light["outerConeAngle"]), math.cos(light["innerConeAngle"])
        data.spot_size = 2 * light["outerConeAngle"]
        data.spot_blend = (inner - outer) / (1 - outer)
    node = bpy.data.objects.new(light["name"], data)
    turn = Vector(light.get("direction") or (0, 0, -1)).to_track_quat("-Z", "Y").to_matrix().to_4x4()  # lights shine along -Z
    node.matrix_world = kToBlender @ Matrix.Translation(light.get("position") or (0, 0, 0)) @ turn
    bpy.context.scene.collection.objects.link(node)


def makeWorld(environment):
    """The map lights the scene, and camera rays see a colour. Returns the colour's input."""
    world = bpy.data.worlds.new("contract")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    light, seen, mix = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeMixShader")
    light.inputs["Color"].default_value = (0, 0, 0, 1)
    if environment:
        image = bpy.data.images.load(environment)
        if not (image.size[0] and image.size[1]):
            raise Refused(f"{environment}: it is not a picture that Blender can read")
        spaces = {each.identifier for each in image.colorspace_settings.bl_rna.properties["name"].enum_items}
        image.colorspace_settings.name = "Linear" if "Linear" in spaces else "Linear Rec.709"  # the latter since Blender 4
        texture = nodes.new("ShaderNodeTexEnvironment")
        texture.image = image
        links.new(texture.outputs["Color"], light.inputs["Color"])
    links.new(nodes.new("ShaderNodeLightPath").outputs["Is Camera Ray"], mix.inputs[0])
    links.new(light.outputs[0], mix.inputs[1])
    links.new(seen.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], nodes.new("ShaderNodeOutputWorld").inputs["Surface"])
    return seen.inputs["Color"]


def makeCamera():
    node = bpy.data.objects.new("contract", bpy.data.cameras.new("contract"))
    bpy.context.scene.collection.objects.link(node)
    bpy.context.scene.camera = node
    return node


def setCamera(node, view):
    camera = view["camera"]
    columns = lambda m: Matrix([m[i::4] for i in range(4)])  # from column-major
    projection = columns(camera["projection"])
    node.matrix_world = kToBlender @ columns(camera["view"]).inverted()
    scaleY, aspect = projection[1][1], view["width"] / view["height"]
    offsets = (projection[0][2], projection[1][2]) if not camera["orthographic"] else (projection[0][3], projection[1][3])
    if abs(projection[0][0] * aspect / scaleY - 1) > 1e-4 or max(map(abs, offsets)) > 1e-6:
        raise Refused(f"{view['picture']}: its pixels are not square, or its projection is not centred")
    data = node.data
    data.sensor_fit, data.sensor_height, data.shift_x, data.shift_y = "VERTICAL", 24, 0, 0
    data.clip_start, data.clip_end = camera["near"], camera["far"]
    if camera["orthographic"]:
        data.type, data.ortho_scale = "ORTHO", 2 / scaleY
    else:
        data.type, data.lens = "PERSP", data.sensor_height / 2 * scaleY


def setOutput(options):
    scene = bpy.context.scene
    render, display = scene.render, scene.view_settings
    display.view_transform, display.look, display.gamma = "Standard", "None", 1  # sRGB without a curve
    scene.display_settings.display_device = "sRGB"
    render.resolution_percentage, render.dither_intensity, render.use_border = 100, 0, False
    render.image_settings.file_format, render.image_settings.color_mode, render.image_settings.color_depth = "PNG", "RGB", "8"
    if options.engine == "eevee":
        names = {each.identifier for each in render.bl_rna.properties["engine"].enum_items}
        render.engine = "BLENDER_EEVEE" if "BLENDER_EEVEE" in names or bpy.app.version < (4, 2) else "BLENDER_EEVEE_NEXT"
        scene.eevee.taa_render_samples, render.filter_size = options.samples, 1
        return
    render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.seed = "CPU", options.samples, 0
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    # No shortcut that makes a picture darker or smoother than the truth.
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = cycles.blur_glossy = 0


def renderScene(scene, options):
    at = lambda file: os.path.normpath(os.path.join(options.contract, file))
    started = time.monotonic()
    with quiet():
        bpy.ops.wm.read_factory_settings(use_empty=True)
        loadModel(at(scene["scene"]))
        background = makeWorld(at(scene["environment"]["file"]) if scene.get("environment") else None)
        for light in scene.get("lights", []):
            addLight(light)
        camera = makeCamera()
        setOutput(options)
    print(f"{scene['name']}: loaded in {time.monotonic() - started:.2f} s", flush=True)
    for view in scene["views"]:
        began = time.monotonic()
        picture = os.path.join(options.shots, view["picture"])
        with quiet():
            setCamera(camera, view)
            background.default_value = (*view["background"], 1)
            render = bpy.context.scene.render
            render.resolution_x, render.resolution_y = view["width"], view["height"]
            bpy.context.scene.view_settings.exposure = view["exposureEv"]
            bpy.context.scene.cycles.filter_width = view.get("filterWidth", 1)
            render.filepath = picture
            if os.path.exists(picture):
                os.remove(picture)
            bpy.ops.render.render(write_still=True)
        if not os.path.isfile(picture):
            raise Refused(f"{picture}: Blender has not written it")
        print(f"{view['picture']}: {view['width']}x{view['height']}, {options.samples} samples, {time.monotonic() - began:.2f} s", flush=True)


def main():
    options = readOptions()
    options.contract, options.shots = os.path.abspath(options.contract), os.path.abspath(options.shots)
    try:
        if options.engine == "eevee" and bpy.app.background and sys.platform == "linux" and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
            raise Refused("--engine eevee: Eevee draws by OpenGL and needs a display; there is none here, so use cycles")
        scenes = readContract(options.contract, options.scene)
        os.makedirs(options.shots, exist_ok=True)
        for scene in scenes:
            renderScene(scene, options)
    except Refused as error:
        print(f"render.py: {error}", file=sys.stderr)
        sys.exit(1)
    except Exception as error:  # pylint: disable=broad-except # Blender itself would end with 0
        print(f"render.py: {options.contract}: {type(error).__name__}: {error}", file=sys.stderr)
        sys.exit(1)


main()
