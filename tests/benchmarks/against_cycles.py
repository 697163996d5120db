# Run inside Blender by the script of this name.
import math, os, resource, subprocess, sys

import bpy
import mathutils
import numpy as np
import OpenImageIO as oiio

OUT, LAMP, RESOLUTION, *PROGRAMS = sys.argv[sys.argv.index("--") + 1:]
WIDTH, HEIGHT = [int(number) for number in RESOLUTION.split("x")]
CAR_M, LAMP_M, EYE_M, PITCH_DEG, FOV_DEG = 20, (23.4, 0.6, 0.65), (21.3, 0.35, 1.2), -1, 40  # y counts from the road's centre
ROAD_WIDTH_M, ROAD_M = 40, 400
BOXES = [  # x, y, heading, length, width, height; m and radians
    (38, -3.1, 0.3, 0.8, 0.6, 0.5), (44, 1.5, 0.1, 4.2, 1.8, 1.4), (52, -1, 0.7, 0.4, 0.4, 0.9), (60, -4, 0.2, 4.2, 1.8, 1.4),
    (75, 3.5, 0.4, 0.3, 0.3, 1.1), (90, -2, 0.9, 1.5, 1.5, 1.2)]


def cpu_s(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def channels(path, *names):
    buffer = oiio.ImageBuf(path)
    pixels = buffer.get_pixels(oiio.FLOAT)
    os.remove(path)
    return [pixels[:, :, buffer.spec().channelnames.index(name)].astype(np.float64) for name in names]


def write_drive():
    boxes = "".join('<object id="%d" name="box" type="obstacle" s="%g" t="%g" zOffset="0" hdg="%g" orientation="none" length="%g" '
                    'width="%g" height="%g"/>' % (i, x, y - ROAD_WIDTH_M / 2, *turn_and_size)
                    for i, (x, y, *turn_and_size) in enumerate(BOXES))
    with open(OUT + "/road.xodr", "w") as file:
        file.write('<OpenDRIVE><header revMajor="1" revMinor="6" name="boxes"/><road name="boxes" length="%g" id="1" junction="-1">'
                   '<planView><geometry s="0" x="0" y="0" hdg="0" length="%g"><line/></geometry></planView><lanes><laneSection s="0">'
                   '<center><lane id="0" type="none" level="false"/></center><right><lane id="-1" type="driving" level="false">'
                   '<width sOffset="0" a="%g" b="0" c="0" d="0"/></lane></right></laneSection></lanes><objects>%s</objects></road>'
                   '</OpenDRIVE>' % (ROAD_M, ROAD_M, ROAD_WIDTH_M, boxes))
    with open(OUT + "/boxes.yaml", "w") as file:
        file.write("fernlicht: 1\nroad: road.xodr\nroute: {s_m: %g}\nspeed_kmh: 1\nduration_s: 1\ntextures: none\n"
                   "car: {mounts: {lamp: [%g, %g, %g]}}\nlamp_sets: {one: {source: filament, lamps: {lamp: %s}}}\n"
                   "views: {driver: {position_m: [%g, %g, %g], pitch_deg: %g, vertical_fov_deg: %g, resolution_px: [%d, %d]}}\n"
                   % (CAR_M, LAMP_M[0] - CAR_M, *LAMP_M[1:], os.path.abspath(LAMP), EYE_M[0] - CAR_M, *EYE_M[1:], PITCH_DEG, FOV_DEG,
                      WIDTH, HEIGHT))


def ours(program, target, *flags):
    """Mean and mesh numbers; CPU time of the whole command."""
    folder = OUT + "/ours"
    subprocess.run(["rm", "-rf", folder], check=True)
    before = cpu_s(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "reference", OUT + "/boxes.yaml", "--quiet", "--out", folder, "--target-error", target, *flags], check=True,
                   stdout=subprocess.DEVNULL)
    return *channels(folder + "/reference.exr", "illuminance.lx", "ids"), cpu_s(resource.RUSAGE_CHILDREN) - before


def write_type_c():
    """The lamp's own table for Cycles: angles H and V of type A are C - 180 and gamma - 90 of type C. Darkness all round."""
    numbers = [float(word) for word in open(LAMP).read().split("TILT=NONE")[1].split()]
    v_count, h_count = int(numbers[3]), int(numbers[4])
    v, h = numbers[13:13 + v_count], numbers[13 + v_count:13 + v_count + h_count]
    cd = np.array(numbers[13 + v_count + h_count:]).reshape(h_count, v_count)
    cd = np.pad(cd, ((2, 2), (2, 2)))
    gamma = [0, 90 + v[0] - 0.01, *[90 + a for a in v], 90 + v[-1] + 0.01, 180]
    c = [0, 180 + h[0] - 0.01, *[180 + a for a in h], 180 + h[-1] + 0.01, 360]
    with open(OUT + "/lamp.ies", "w") as file:
        file.write("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 %d %d 1 2 0 0 0\n1 1 0\n" % (len(gamma), len(c)))
        for row in (gamma, c, *cd):
            file.write(" ".join("%.9g" % value for value in row) + "\n")


def mesh(name, corners, faces, material):
    data = bpy.data.meshes.new(name)
    data.from_pydata(corners, [], faces)
    data.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, data))


def build_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    white = bpy.data.materials.new("white")
    white.use_nodes = True
    nodes = white.node_tree.nodes
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (1, 1, 1, 1)
    white.node_tree.links.new(diffuse.outputs[0], output.inputs[0])
    half = ROAD_WIDTH_M / 2
    mesh("road", [(0, -half, 0), (ROAD_M, -half, 0), (ROAD_M, half, 0), (0, half, 0)], [(0, 1, 2, 3)], white)
    for x, y, turn, length, width, height in BOXES:
        place = mathutils.Matrix.Translation((x, y, 0)) @ mathutils.Matrix.Rotation(turn, 4, "Z")
        corners = [place @ mathutils.Vector((i * length / 2, j * width / 2, k * height)) for k in (0, 1) for i, j in
                   ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        mesh("box", corners, [(4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)], white)
    light = bpy.data.lights.new("lamp", "POINT")
    light.shadow_soft_size = 0
    light.energy = 1000
    light.use_nodes = True
    nodes, links = light.node_tree.nodes, light.node_tree.links
    ies = nodes.new("ShaderNodeTexIES")
    ies.mode, ies.filepath = "EXTERNAL", OUT + "/lamp.ies"
    links.new(ies.outputs[0], nodes["Emission"].inputs["Strength"])
    lamp = bpy.data.objects.new("lamp", light)
    lamp.location, lamp.rotation_euler = LAMP_M, (0, 0, math.radians(-90))
    scene.collection.objects.link(lamp)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.sensor_fit, camera.data.angle, camera.data.clip_end = "VERTICAL", math.radians(FOV_DEG), 1000
    camera.location = EYE_M
    camera.rotation_euler = (math.radians(90 + PITCH_DEG), 0, math.radians(-90))
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.world = bpy.data.worlds.new("night")
    scene.world.color = (0, 0, 0)
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = OUT + "/theirs.exr"
    cycles = scene.cycles
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1
    cycles.max_bounces = cycles.diffuse_bounces = 0
    cycles.light_sampling_threshold = cycles.sample_clamp_direct = 0
    cycles.use_denoising = False
    return scene


def theirs(scene, samples, threshold=0.0, seed=0):
    """Radiance; CPU time of rendering and writing alone, without Blender's start."""
    scene.cycles.samples, scene.cycles.seed = samples, seed
    scene.cycles.use_adaptive_sampling, scene.cycles.adaptive_threshold = threshold > 0, threshold
    before = cpu_s(resource.RUSAGE_SELF)
    bpy.ops.render.render(write_still=True)
    cpu = cpu_s(resource.RUSAGE_SELF) - before
    return *channels(scene.render.filepath, "R"), cpu


def measures(found, truth, where):
    """In per cent of the truth: RMS, RMS without the worst 0.1 %, median, 95 %."""
    error = np.sort(np.abs(found[where] / truth[where] - 1)) * 100
    return [math.sqrt(np.mean(error ** 2)), math.sqrt(np.mean(error[:int(0.999 * len(error))] ** 2)), np.median(error),
            error[int(0.95 * len(error))]]


def row(who, setting, cpu, errors):
    print("| %s | %s | %.2f | %s |" % (who, setting, cpu, " | ".join("%.3g" % error for error in errors)), flush=True)


def cpu_at(series, measure, error):
    """Of a series of (cpu, errors), along straight lines of logarithms; None outside."""
    for (cpu_a, a), (cpu_b, b) in zip(series, series[1:]):
        if a[measure] >= error >= b[measure] and a[measure] > b[measure]:
            part = math.log(a[measure] / error) / math.log(a[measure] / b[measure])
            return cpu_a * (cpu_b / cpu_a) ** part
    return None


write_drive()
write_type_c()
scene = build_scene()
our_truth, ids, _ = ours(PROGRAMS[-1], "0.003%", "--max-samples", "16384", "--seed", "99")
their_truth, _ = theirs(scene, 2048, seed=99)
ratio = our_truth / np.maximum(their_truth, 1e-9)
factor = np.median(ratio[our_truth > 1])
their_truth *= factor
where = (our_truth >= 0.05) & (their_truth >= 0.05)
print("%d pixels of at least 0.05 lx; of those above 1 lx half differ by less than %.2f %% between the two" % (
    where.sum(), 100 * np.median(np.abs(ratio[our_truth > 1] / factor - 1))))
print("| | samples, threshold or target | CPU s | RMS, % | RMS without the worst 0.1 %, % | median, % | 95 %, % |\n|---|---|---|---|---|---|---|")
fixed, adaptive, found = [], [], []
for samples, threshold, target in ((4, 0.3, "5%"), (8, 0.1, "2%"), (16, 0.03, "1%"), (32, 0.01, "0.5%"), (64, 0.003, "0.2%"), (128, 0, ""), (256, 0, "")):
    for series, setting, flags in ((fixed, "%d" % samples, (samples,)), (adaptive, "at most 1024, %g" % threshold, (1024, threshold))):
        if flags[-1] > 0:
            radiance, cpu = theirs(scene, *flags)
            series.append((cpu, measures(radiance * factor, their_truth, where)))
            row("Cycles", setting, *series[-1])
    for program in PROGRAMS if target else []:
        mean, _, cpu = ours(program, target)
        found.append((program, target, cpu, measures(mean, our_truth, where)))
        row(*found[-1])
print("\nCPU time of Cycles at the same error, by its quicker way, over ours:\n| | target | RMS | without the worst 0.1 % | median | 95 % |\n|---|---|---|---|---|---|")
for program, target, cpu, errors in found:
    times = []
    for measure, error in enumerate(errors):
        theirs_s = [at for series in (fixed, adaptive) if (at := cpu_at(series, measure, error)) is not None]
        least_known = max(fixed[-1][0], adaptive[-1][0])
        below = error < min(fixed[-1][1][measure], adaptive[-1][1][measure])
        times.append("%.2g" % (min(theirs_s) / cpu) if theirs_s else "> %.2g" % (least_known / cpu) if below else "?")
    print("| %s | %s | %s |" % (program, target, " | ".join(times)))
