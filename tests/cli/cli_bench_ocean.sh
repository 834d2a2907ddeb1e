#!/usr/bin/env bash
# bench ocean: a row for each task and way.
# shellcheck source=driver.sh disable=SC2154
. "$(dirname "$0")/driver.sh"
run bench ocean --sizes 1000 --rounds 1 --format tsv -q; exits 0
prints_line $'^task\tway\tseconds\tns\tratio$'
prints_line $'^apply\tcopy\t[0-9.e+-]*\t[0-9.e+-]*\t1$'
prints_line $'^apply\tfloats, in steps\t'
prints_line $'^hints\thints\t'
"$meshwalk" --version | grep -q 'libnetcdf is not found' || prints_line $'^open\tUGRID\t'
only_files
run bench ocean set; refused 2 'makes its own meshes'
run bench ocean --tasks random; refused 2 'makes its own meshes'
finish
