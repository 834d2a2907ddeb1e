"""Are the polygons of a GeoJSON file valid by the OGC's rules? GEOS decides.

Prints what is wrong with each that is not valid; then the areas of all of them for each `min`, and
the sum of all, as "area MIN AREA" and "sum AREA". Fails with 77 if there is no GEOS.
"""

import ctypes
import json
import sys

try:
    geos = ctypes.CDLL("libgeos_c.so.1")
    read = geos.GEOSGeoJSONReader_readGeometry_r
except (OSError, AttributeError):
    sys.exit(77)
p = ctypes.c_void_p
context = geos.GEOS_init_r
context.restype = p
context = p(context())
geos.GEOSGeoJSONReader_create_r.restype = p
reader = p(geos.GEOSGeoJSONReader_create_r(context))
read.restype = p
read.argtypes = [p, p, ctypes.c_char_p]
geos.GEOSisValid_r.argtypes = [p, p]
geos.GEOSisValidReason_r.argtypes = [p, p]
geos.GEOSisValidReason_r.restype = ctypes.c_char_p
geos.GEOSArea_r.argtypes = [p, p, ctypes.POINTER(ctypes.c_double)]
geos.GEOSGeom_destroy_r.argtypes = [p, p]
areas = {}
with open(sys.argv[1]) as file:
    features = json.load(file)["features"]
for feature in features:
    geometry = read(context, reader, json.dumps(feature["geometry"]).encode())
    if geos.GEOSisValid_r(context, geometry) != 1:
        reason = geos.GEOSisValidReason_r(context, geometry).decode()
        print("polygon", feature["properties"]["polygon"], "is not valid:", reason)
    area = ctypes.c_double()
    geos.GEOSArea_r(context, geometry, ctypes.byref(area))
    low = feature["properties"]["min"]
    areas[low] = areas.get(low, 0) + area.value
    geos.GEOSGeom_destroy_r(context, geometry)
for low, area in areas.items():
    print("area", low, f"{area:.9g}")
print("sum", f"{sum(areas.values()):.9g}")
