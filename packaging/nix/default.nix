# Nix: `nix-build packaging/nix` makes the program, the library and their manual of this tree.
{
  pkgs ? import <nixpkgs> { },
}:
let
  inherit (pkgs) lib stdenv;
  root = ../..;
in
stdenv.mkDerivation {
  pname = "meshwalk";
  version = builtins.head (
    builtins.match ".*MW_VERSION_STRING \"([^\"]*)\".*" (
      builtins.readFile (root + "/include/meshwalk/version.h")
    )
  );
  src = lib.cleanSource root;

  nativeBuildInputs = [
    pkgs.cmake
    pkgs.ninja
    pkgs.pkg-config
    pkgs.patchelf
  ];
  buildInputs = [
    pkgs.cairo
    pkgs.gdal
    pkgs.jansson
    pkgs.zlib
  ];
  cmakeFlags = [
    "-DBUILD_SHARED_LIBS=ON"
    "-DMW_BUILD_MPI=OFF"
    "-DMW_BUILD_WEB=OFF"
  ];

  # GDAL and netCDF are loaded by name while the program runs.
  postFixup = ''
    patchelf --add-rpath ${lib.makeLibraryPath [ pkgs.gdal ]} $out/bin/meshwalk
    patchelf --add-rpath ${lib.makeLibraryPath [ pkgs.netcdf ]} $out/lib/libmeshwalk.so
  '';

  meta = {
    description = "Exact point location in triangle meshes by walking";
    license = lib.licenses.mit;
    mainProgram = "meshwalk";
    platforms = lib.platforms.linux;
  };
}
