/* gdal_library.h - GDAL, loaded while the program runs.
 *
 * GDAL takes tens of milliseconds and tens of megabytes to load, so the program is not linked with
 * it. The library is loaded when a file is met that nothing else reads, or while a mesh is read, if
 * the output will need it. */
#ifndef MW_CLI_GDAL_GDAL_LIBRARY_H
#define MW_CLI_GDAL_GDAL_LIBRARY_H

#include <stdbool.h>

/* Was the program built with GDAL? */
bool gdal_library_built(void);

/* Wait for a thread of gdal_library_begin: the program must not end before. */
void gdal_library_end(void);

#ifdef MW_GDAL

#include <gdal.h>
#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#define GDAL_FUNCTIONS(F)                                                                          \
    F(CPLSetErrorHandler)                                                                          \
    F(CPLQuietErrorHandler)                                                                        \
    F(CPLErrorReset)                                                                               \
    F(CPLSetConfigOption)                                                                          \
    F(CPLGetConfigOption)                                                                          \
    F(CPLGetLastErrorType)                                                                         \
    F(CPLGetLastErrorMsg)                                                                          \
    F(GDALAllRegister)                                                                             \
    F(GDALOpenEx)                                                                                  \
    F(GDALGetDriverByName)                                                                         \
    F(GDALCreate)                                                                                  \
    F(GDALCreateCopy)                                                                              \
    F(GDALGetCacheMax64)                                                                           \
    F(GDALSetCacheMax64)                                                                           \
    F(GDALGetMetadataItem)                                                                         \
    F(GDALSetGeoTransform)                                                                         \
    F(GDALGetGeoTransform)                                                                         \
    F(GDALSetSpatialRef)                                                                           \
    F(GDALGetSpatialRef)                                                                           \
    F(GDALGetRasterBand)                                                                           \
    F(GDALGetRasterCount)                                                                          \
    F(GDALGetRasterXSize)                                                                          \
    F(GDALGetRasterYSize)                                                                          \
    F(GDALSetRasterNoDataValue)                                                                    \
    F(GDALGetRasterNoDataValue)                                                                    \
    F(GDALRasterIO)                                                                                \
    F(GDALWriteBlock)                                                                              \
    F(GDALGetBlockSize)                                                                            \
    F(GDALSetDescription)                                                                          \
    F(GDALGetRasterOffset)                                                                         \
    F(GDALGetRasterScale)                                                                          \
    F(GDALGetRasterDataType)                                                                       \
    F(GDALDatasetCreateLayer)                                                                      \
    F(GDALDatasetStartTransaction)                                                                 \
    F(GDALDatasetCommitTransaction)                                                                \
    F(GDALVersionInfo)                                                                             \
    F(GDALGetDatasetDriver)                                                                        \
    F(GDALGetDriverShortName)                                                                      \
    F(OSRNewSpatialReference)                                                                      \
    F(OSRSetFromUserInput)                                                                         \
    F(OSRSetAxisMappingStrategy)                                                                   \
    F(OSRDemoteTo2D)                                                                               \
    F(OSRIsSameEx)                                                                                 \
    F(OSRIsProjected)                                                                              \
    F(OSRIsCompound)                                                                               \
    F(OSRGetAxesCount)                                                                             \
    F(OSRGetLinearUnits)                                                                           \
    F(OSRGetTargetLinearUnits)                                                                     \
    F(OSRGetAttrValue)                                                                             \
    F(OSRIsGeographic)                                                                             \
    F(OSRGetName)                                                                                  \
    F(OSRGetAuthorityName)                                                                         \
    F(OSRGetAuthorityCode)                                                                         \
    F(OSRGetPROJVersion)                                                                           \
    F(OCTNewCoordinateTransformationOptions)                                                       \
    F(OCTCoordinateTransformationOptionsSetBallparkAllowed)                                        \
    F(OCTDestroyCoordinateTransformationOptions)                                                   \
    F(OCTNewCoordinateTransformationEx)                                                            \
    F(OCTClone)                                                                                    \
    F(OCTTransformEx)                                                                              \
    F(OCTDestroyCoordinateTransformation)                                                          \
    F(OGR_L_GetExtent)                                                                             \
    F(OGR_L_GetFeatureCount)                                                                       \
    F(OGRGeometryTypeToName)                                                                       \
    F(OSRExportToWkt)                                                                              \
    F(OSRRelease)                                                                                  \
    F(VSIFree)                                                                                     \
    F(OGR_L_GetSpatialRef)                                                                         \
    F(OGR_L_CreateField)                                                                           \
    F(OGR_L_CreateFeature)                                                                         \
    F(OGR_Fld_Create)                                                                              \
    F(OGR_Fld_SetWidth)                                                                            \
    F(OGR_Fld_Destroy)                                                                             \
    F(OGR_F_Create)                                                                                \
    F(OGR_F_SetFieldNull)                                                                          \
    F(OGR_F_SetFieldInteger64)                                                                     \
    F(OGR_F_SetFieldDouble)                                                                        \
    F(OGR_F_SetFieldString)                                                                        \
    F(OGR_F_SetGeometryDirectly)                                                                   \
    F(OGR_G_CreateGeometry)                                                                        \
    F(OGR_G_AddGeometryDirectly)                                                                   \
    F(OGR_G_SetPoint)                                                                              \
    F(OGR_G_SetPoint_2D)                                                                           \
    F(OGR_G_SetPoints)                                                                             \
    F(GDALClose)                                                                                   \
    F(GDALDatasetGetLayerCount)                                                                    \
    F(GDALDatasetGetLayer)                                                                         \
    F(OGR_L_GetName)                                                                               \
    F(OGR_L_GetGeomType)                                                                           \
    F(OGR_L_GetLayerDefn)                                                                          \
    F(OGR_L_SetAttributeFilter)                                                                    \
    F(OGR_L_ResetReading)                                                                          \
    F(OGR_L_GetNextFeature)                                                                        \
    F(OGR_FD_GetFieldCount)                                                                        \
    F(OGR_FD_GetFieldDefn)                                                                         \
    F(OGR_Fld_GetNameRef)                                                                          \
    F(OGR_Fld_GetType)                                                                             \
    F(OGR_F_GetFID)                                                                                \
    F(OGR_F_IsFieldSetAndNotNull)                                                                  \
    F(OGR_F_GetFieldAsDouble)                                                                      \
    F(OGR_F_GetFieldAsString)                                                                      \
    F(OGR_F_GetGeometryRef)                                                                        \
    F(OGR_F_Destroy)                                                                               \
    F(OGR_G_GetLinearGeometry)                                                                     \
    F(OGR_G_DestroyGeometry)                                                                       \
    F(OGR_G_GetGeometryName)                                                                       \
    F(OGR_G_GetGeometryType)                                                                       \
    F(OGR_GT_Flatten)                                                                              \
    F(OGR_GT_HasZ)                                                                                 \
    F(OGR_G_Is3D)                                                                                  \
    F(OGR_G_GetGeometryCount)                                                                      \
    F(OGR_G_GetGeometryRef)                                                                        \
    F(OGR_G_GetPointCount)                                                                         \
    F(OGR_G_GetPoint)

/* The functions of GDAL that the program calls, under their own names. */
typedef struct gdal_functions {
#define GDAL_MEMBER(name) __typeof__(name) *name;
    GDAL_FUNCTIONS(GDAL_MEMBER)
#undef GDAL_MEMBER
} gdal_functions;

/* Begin to load GDAL, in a thread of its own: it will be needed, after other work. */
void gdal_library_begin(void);

/* Load GDAL, if it is not loaded yet; errors are then kept quiet. NULL if it cannot be loaded. */
const gdal_functions *gdal_library_load(void);

/* Open a file to read, as GDAL_OF_VECTOR or GDAL_OF_RASTER. NULL after a complaint: what GDAL says,
 * or else `otherwise`. */
GDALDatasetH gdal_library_open(const char *path, unsigned kind, const char *otherwise);

#endif

#endif
