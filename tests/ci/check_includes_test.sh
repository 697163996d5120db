#!/usr/bin/env bash
# ci/check-includes on small trees: quiet about a lawful one, and each law broken once is named with its file and line.
set -uo pipefail
check=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/ci/check-includes
tree=$(mktemp --directory)
trap 'rm -rf "$tree"' EXIT
failures=0

lawful() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree"/{scenarios/lamps,metrics,renderer/gl,renderer/shaders,renderer/reference,runner/report,runner/judge,tests/metrics,ci,build/release,out/demo-1}
    printf '#include "scenarios/lamps/table.h"\n#include <boost/numeric/odeint.hpp>\n' >"$tree/scenarios/lamps/texture.cpp"
    printf '#pragma once\n#include <vector>\n' >"$tree/scenarios/lamps/table.h"
    printf '#include "metrics/extent.h"\n#include "scenarios/lamps/table.h"\n' >"$tree/metrics/extent.cpp"
    printf '#include <glad/gl.h>\n#include <EGL/egl.h>\n#include "shader_files.h"\n#include "renderer/camera.h"\n' >"$tree/renderer/gl/context.cpp"
    printf '#include <embree3/rtcore.h>\n' >"$tree/renderer/reference/trace.cpp"
    printf '#include "photometry.glsl"\n' >"$tree/renderer/shaders/lamps.glsl"
    printf '#include "report_files.h"\n#include "renderer/renderer.h"\n#include "metrics/extent.h"\n#include <boost/math/special_functions.hpp>\n' >"$tree/runner/report/html.cpp"
    printf '#include "tests/metrics/frames.h"\n#include "metrics/extent.h"\n#include <boost/math/special_functions.hpp>\n' >"$tree/tests/metrics/extent_test.cpp"
    printf 'int generated;\n' >"$tree/build/release/generated.cpp"
    printf '#include "runner/judge/limits.h"\n' >"$tree/runner/report/html.h"
    printf '#pragma once\n' | tee "$tree/runner/judge/limits.h" >"$tree/scenarios/values.h"
    printf '# a word\nscenarios:\nscenarios/lamps:\nmetrics:\nrenderer:\nrenderer/gl: .\nrenderer/reference:\nrunner:\nrunner/judge:\nrunner/report: judge\n' >"$tree/ci/arrows"
}

# breach FILE LINE PATTERN: adds LINE at the end of FILE and expects a complaint about that file that matches PATTERN.
breach() {
    lawful
    mkdir -p "$(dirname "$tree/$1")"
    printf '%s\n' "$2" >>"$tree/$1"
    local line said
    line=$(wc -l <"$tree/$1")
    if said=$("$check" "$tree" 2>/dev/null); then
        echo "not noticed: $2 in $1"
        ((++failures))
    elif [[ $said != "$1:$line: "*$3* ]]; then
        echo "wrong words for $2 in $1: $said"
        ((++failures))
    fi
}

lawful
said=$("$check" "$tree" 2>&1) || { echo "a lawful tree was refused: $said"; ((++failures)); }

breach scenarios/lamps/table.h '#include "metrics/extent.h"' 'scenarios must not know'
breach scenarios/lamps/table.h '#include "renderer/renderer.h"' 'scenarios must not know'
breach metrics/extent.cpp '#include "renderer/renderer.h"' 'metrics must not know'
breach metrics/extent.cpp '#include "runner/report/report.h"' 'metrics must not know'
breach renderer/gl/context.cpp '#include "metrics/extent.h"' 'renderer must not know'
breach renderer/gl/context.cpp '  #  include "runner/play.h"' 'renderer must not know'
breach tests/metrics/extent_test.cpp '#include "renderer/renderer.h"' 'metrics must not know'
breach runner/report/html.cpp '#include "tests/metrics/frames.h"' 'runner must not know'
breach renderer/camera.h '#include <glad/gl.h>' 'belongs in renderer/gl/'
breach runner/doctor.cpp '#include <EGL/egl.h>' 'belongs in renderer/gl/'
breach tests/metrics/extent_test.cpp '#include <GL/osmesa.h>' 'belongs in renderer/gl/'
breach renderer/gl/context.cpp '#include <embree3/rtcore.h>' 'belongs in renderer/reference/'
breach runner/report/html.cpp '#include <OpenImageIO/imageio.h>' 'belongs in runner/modules/openimageio.cpp'
breach tests/metrics/extent_test.cpp '#include <librsvg/rsvg.h>' 'belongs in runner/modules/svg.cpp'
breach scenarios/lamps/table.h '#include <OpenEXR/ImfHeader.h>' 'belongs in scenarios/values/exr_file.cpp'
breach scenarios/lamps/writer.cpp '#include <boost/math/special_functions.hpp>' 'Boost is already included by scenarios/lamps/texture.cpp'
breach metrics/ssim.h '#include <opencv2/core.hpp>' 'OpenCV in a header'
breach scenarios/vehicle/steps.h '#include <boost/numeric/odeint.hpp>' 'Boost in a header'
breach runner/bus.h '#include <linux/can/raw.h>' 'belongs in runner/play/live/can_socket.cpp'
breach metrics/extent.cpp '#include "shader_files.h"' 'belongs to renderer'
breach metrics/extent.cpp '#include "extent.h"' 'path from the top'
breach metrics/extent.cpp '#include <scenarios/light.h>' 'in quotes'
breach renderer/shaders/lamps.glsl '#include "scenarios/photometry.glsl"' 'by file name'

breach runner/judge/limits.h '#include "runner/report/html.h"' 'runner/judge must not know "runner/report/html.h": ci/arrows has no arrow to runner/report'
breach scenarios/values.h '#include "scenarios/lamps/table.h"' 'ci/arrows has no arrow to scenarios/lamps'
breach renderer/gl/deep/pass.h '#include "renderer/camera.h"' 'renderer/gl/deep must not know'
breach ci/arrows 'runner/write: report plots' 'runner/write sees runner/plots, which is not above it'
breach ci/arrows 'runner/report: report' 'runner/report sees runner/report, which is not above it'

# An arrow that nothing follows any more, and a folder without a line.
for law in 's/^runner: *$/runner: judge/' '/^metrics:/d'; do
    lawful
    sed -i "$law" "$tree/ci/arrows"
    if "$check" "$tree" >/dev/null 2>&1; then
        echo "not noticed: ci/arrows after $law"
        ((++failures))
    fi
done

lawful
mkdir "$tree/common"
echo 'int x;' >"$tree/common/strings.cpp"
if "$check" "$tree" >/dev/null 2>&1; then
    echo "not noticed: a further top-level code folder"
    ((++failures))
fi
rm -rf "${tree:?}"/*
if "$check" "$tree" >/dev/null 2>&1; then
    echo "not noticed: a tree without code"
    ((++failures))
fi

((failures == 0))
