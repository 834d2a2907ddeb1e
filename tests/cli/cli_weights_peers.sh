#!/usr/bin/env bash
# weights: uxarray's remapping and xESMF's reader of weights take our files, and give the values of
# sample.
# shellcheck source=driver.sh disable=SC2034,SC2154
. "$(dirname "$0")/driver.sh"
peers=${MESHWALK_PEERS:-$(dirname "$meshwalk")/../python/peers}
if "$meshwalk" --version | grep -q 'libnetcdf is not found'; then
    left_out "libnetcdf is not found"
    exit 0
fi
if [[ ! -e $peers/xesmf/smm.py ]]; then
    left_out "uxarray and xESMF's smm.py are not in $peers (tools/peer_env $peers python3)"
    exit 0
fi
# 200 points in a mesh of 300 vertices, some of them outside.
awk 'BEGIN { srand(1); print "x,y,z"
    for (i = 0; i < 300; i++) printf "%.6f,%.6f,%.6f\n", 10 * rand(), 10 * rand(), rand() }' \
    >vertices.csv
awk 'BEGIN { srand(2); print "x,y"
    for (i = 0; i < 200; i++) printf "%.6f,%.6f\n", 11 * rand() - 0.5, 11 * rand() - 0.5 }' \
    >points.csv
run triangulate -q vertices.csv -o mesh.nc; exits 0
run weights -q mesh.nc points.csv -o weights.nc; exits 0
run sample -q mesh.nc points.csv -o values.csv; exits 0
cat >compare.py <<'END'
import sys
import warnings

import netCDF4
import numpy as np
import xarray as xr

warnings.simplefilter("ignore")
sys.path.insert(0, sys.argv[1])
import smm
from uxarray.remap import load_remap_weights

with netCDF4.Dataset("mesh.nc") as mesh:
    z = mesh["mesh2d_node_z"][:].filled(np.nan)
wanted = np.genfromtxt("values.csv", delimiter=",", skip_header=1)[:, 2]
inside = ~np.isnan(wanted)
assert 100 < inside.sum() < 200

weights = smm.read_weights("weights.nc", len(z), len(wanted))
assert weights.shape == (len(wanted), len(z))
shape = (1, len(wanted)), (1, len(z))
matrix = smm.add_nans_to_weights(weights).data.reshape(shape[0] + shape[1])
given = smm.apply_weights(matrix, z[None], shape[1], shape[0])
assert np.array_equal(np.isnan(given[0]), ~inside)
assert np.abs(given[0] - wanted)[inside].max() < 1e-14

remap = load_remap_weights("weights.nc")
assert remap.source_size == len(z)
given = remap.matrix @ z
assert np.abs(given - wanted)[inside].max() < 1e-14
END
last=compare.py
"$peers/bin/python" compare.py "$peers/xesmf" >"$logs/out" 2>"$logs/err"
code=$?
exits 0
finish
