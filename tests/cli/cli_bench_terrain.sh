#!/usr/bin/env bash
# bench terrain: a row for each program that is there; what is not there is named.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
# As in cli_vectors.sh: the leak checker may crash over the threads of GDAL.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

run bench terrain set; refused 2 'makes its own terrain'
run bench terrain --engines gmt; refused 2 'makes its own terrain'
run bench terrain --tasks slopes; refused 2 "unknown task 'slopes'; there are"
run bench terrain --sizes x; refused 2 "'--sizes'"
if "$meshwalk" --version | grep -q 'GDAL .*found'; then
    mkdir -p scratch
    TMPDIR=$PWD/scratch run bench terrain --sizes 500 --rounds 1 --queries 10000 --format tsv
    exits 0
    holds 'the names of the columns' test "$(head -n 1 "$logs/out")" == \
        $'task\tway\tseconds\tprocessor\tratio\tratio_processor'
    prints_line $'^contours\tmeshwalk contours\t[0-9.e-]+\t[0-9.e-]+\t1\t1$'
    prints_line $'^raster\tmeshwalk raster\t[0-9.e-]+\t[0-9.e-]+\t1\t1$'
    prints_line $'^raster\tmeshwalk prepared\t[0-9.e-]+\t[0-9.e-]+\t[0-9.e-]+\t[0-9.e-]+$'
    prints_line $'^raster\twrite\t[0-9.e-]+\t[0-9.e-]+\t[0-9.e-]+\t[0-9.e-]+$'
    for peer in gmt gdal_grid gdal_contour; do
        if command -v $peer >peer; then
            prints_line "	$peer"
        else
            says "$peer is not installed"
        fi
    done
    holds 'nothing is left behind' test -z "$(ls scratch)"
    # Without any program in the path.
    mkdir -p bin
    for tool in timeout bash cat grep; do ln -sf "$(command -v $tool)" bin/$tool; done
    PATH=$PWD/bin run bench terrain -q --sizes 100 --rounds 1 --queries 100
    exits 0
    says 'gmt is not installed here'
    prints_line '^contours +meshwalk contours'
    PATH=$PWD/bin run bench terrain -q --sizes 100 --rounds 1 --queries 100 --tasks raster
    exits 0
    holds 'one task' test -z "$(grep contours "$logs/out")"
else
    left_out 'GDAL is not found'
fi
finish
