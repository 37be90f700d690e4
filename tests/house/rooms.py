"""The rooms of each module in the order of their floors, lowest first, and what other modules may include.
A file includes only its own room and rooms below it; the root of a module is its roof, in renderer/ its ground."""

ROOMS = {
    "sessions": ("files/system", "files/json", "files", "text", "pictures", "pictures/openimageio", "camera", "format", "streams",
                 "check", "inspect/meters", "inspect", "record", "import/text", "import/map", "import/tables", "import/rows",
                 "import/stamps", "import", "import/cameras", "import/presets", "import/check/roles", "import/check"),
    "scenes": ("model", "animation", "gltf/format", "gltf/file", "gltf", "voxels", "detail", "environment", "document", "changes"),
    "renderer": ("settings", "simd", "threads", "feed", "foveation", "embree", "voxels", "geometry", "detail", "probes", "tiles", "environment",
                 "surfaces", "highlights", "reflectance", "direct_light", "lighting", "tracing", "probe_updates", "viewports", "outside", "frame", "bench"),
    "server": ("text", "diagrams", "process", "quality", "settings", "statistics", "output", "results", "frames/warnings", "frames", "http",
               "replay", "serve", "bench", "check/statistics", "check/report", "check/measure", "check",
               "inspect/acuity", "inspect/probes", "inspect", "look", "synth", "convert", "study/error", "study/statistics",
               "study/report", "study/plan", "study/reference", "study/measure",
               "study/findings", "study/relations", "study/relations/light", "study/relations/place",
               "study/relations/gaze", "study/relations/triangles", "study/relations/probes", "study/relations/control", "study/stability/report", "study",
               "study/stability", "study/rate", "cli"),
}

# Modules whose root holds public headers, which every room may include, and what those headers alone need.
GROUND = ("renderer",)

# Headers that other modules may include; all others are a module's own business.
FACE = {
    "sessions": (
        "sessions/session.h",
        "sessions/camera/camera_image.h", "sessions/camera/camera_model.h",
        "sessions/camera/half_from_samples.h",
        "sessions/files/append_file.h", "sessions/files/atomic_file.h", "sessions/files/contained_folder.h",
        "sessions/text/fixed_text.h", "sessions/files/folder_lock.h", "sessions/files/folders.h",
        "sessions/files/input_error.h", "sessions/files/input_file.h", "sessions/files/line_reader.h", "sessions/files/nearest_name.h",
        "sessions/text/plain_values.h", "sessions/text/written_order.h", "sessions/files/strict_json.h", "sessions/files/system/descriptor.h",
        "sessions/files/write_error.h",
        "sessions/format/covered_by_focus.h", "sessions/format/display_profile.h", "sessions/format/pose.h",
        "sessions/format/session_header.h",
        "sessions/import/cameras/camera_calibration.h", "sessions/import/cameras/camera_pictures.h",
        "sessions/import/cameras/column_lens.h", "sessions/import/cameras/exif_time.h",
        "sessions/import/cameras/name_pattern.h", "sessions/import/cameras/picture_stamps.h",
        "sessions/import/check/bare_formats.h", "sessions/import/check/proposal.h", "sessions/import/import_report.h", "sessions/import/import_rows.h",
        "sessions/import/presets/built_in_maps.h", "sessions/import/presets/camera_table.h",
        "sessions/import/presets/choose_format.h", "sessions/import/presets/fitting_columns.h", "sessions/import/presets/gaze_beside.h",
        "sessions/import/presets/recording_folder.h",
        "sessions/import/text/date_text.h",
        "sessions/inspect/findings.h", "sessions/inspect/number_words.h",
        "sessions/inspect/plausibility.h", "sessions/inspect/recorded_gaze.h", "sessions/inspect/stream_summary.h",
        "sessions/inspect/session_inspection.h",
        "sessions/inspect/time_profile.h",
        "sessions/pictures/exr_header.h", "sessions/pictures/header_bytes.h", "sessions/pictures/image_format.h",
        "sessions/pictures/image_size.h", "sessions/pictures/jpeg_header.h",
        "sessions/pictures/loaded_module.h", "sessions/pictures/png_writer.h", "sessions/pictures/picture_reader.h", "sessions/pictures/png_chunks.h",
        "sessions/record/session_recorder.h",
        "sessions/streams/event_stream.h", "sessions/streams/frame_sample.h", "sessions/streams/gaze_sampler.h",
        "sessions/streams/head_speed.h", "sessions/streams/pose_sampler.h", "sessions/streams/session_options.h",
    ),
    "scenes": (
        "scenes/load_scene.h",
        "scenes/changes/bounding_sphere.h", "scenes/changes/check_changes.h", "scenes/changes/world.h",
        "scenes/document/parse_change.h",
        "scenes/environment/environment_image.h",
        "scenes/model/exposure.h",
        "scenes/model/material_textures.h", "scenes/model/scene.h", "scenes/model/scene_memory.h", "scenes/model/similar_scene.h",
        "scenes/model/transform_checks.h",
        "scenes/model/voxel_grid.h",
    ),
    "renderer": (
        "renderer/bench_frame.h", "renderer/frame_counters.h", "renderer/frame_plan.h", "renderer/further_view.h", "renderer/memory_use.h",
        "renderer/outside_view.h",
        "renderer/polar_picture.h", "renderer/probe_counts.h", "renderer/render_settings.h", "renderer/renderer.h",
        "renderer/setting.h", "renderer/settings_list.h", "renderer/settings_presets.h", "renderer/stage_times.h", "renderer/timing.h",
        "renderer/viewport_image.h",
        "renderer/bench/calibration_rays.h", "renderer/foveation/gaze_frame.h", "renderer/foveation/polar_map.h",
        "renderer/foveation/reached_acuity.h",
        "renderer/probes/probe_reader.h", "renderer/threads/cpu_use.h",
    ),
    "server": (),
}

# Folders of tests that stand for no single room: the whole program, runs of minutes, samples.
TEST_ROOMS = {"renderer": ("samples",), "server": ("program", "program/check", "program/replay", "long")}

# More files than this in one folder are two concepts.
MOST_FILES = 25


def room_of(file, rooms):
    """(module, room) of a file below one of the modules; room "" is the module's root, None a folder that the
    table does not know. The sample generator of scenes/ is a program of its own and stands outside."""
    module, folder = file.parts[0], "/".join(file.parts[1:-1])
    if folder.split("/")[0] == "samples":
        return module, "samples"
    return module, folder if folder == "" or folder in rooms[module] else None
