# SPDX-License-Identifier: GPL-3.0-or-later
#
# BinaryBuilder's recipe for wfpsf_jll, which brings the library to a Julia that has none: the
# package then finds it by `WFPSF_LIBRARY`, set to `wfpsf_jll.libwfpsf`.
#
# usage: WFPSF_TARBALL=file.tar.gz RANDOM123=folder julia build_tarballs.jl
#
# The tarball is what `cpack --config build/release/CPackSourceConfig.cmake` writes; the folder holds
# Random123's headers, philox.h among them, of which there is no JLL.
using BinaryBuilder, Pkg, SHA

name = "wfpsf"
version = v"1.0.0"
tarball = abspath(ENV["WFPSF_TARBALL"])
sources = [
    FileSource("file://" * tarball, bytes2hex(open(sha256, tarball))),
    DirectorySource(abspath(ENV["RANDOM123"]); target = "include/Random123"),
]

script = raw"""
cd $WORKSPACE/srcdir
tar xf wfpsf-*.tar.gz
cd wfpsf-*
cmake -B build -G Ninja -DCMAKE_INSTALL_PREFIX=$prefix -DCMAKE_TOOLCHAIN_FILE=$CMAKE_TARGET_TOOLCHAIN \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="-isystem $WORKSPACE/srcdir/include" \
    -DWFPSF_BUILD_TESTS=OFF -DWFPSF_BUILD_BENCH=OFF -DWFPSF_BUILD_EXAMPLES=OFF \
    -DWFPSF_BUILD_FORTRAN=OFF
cmake --build build
cmake --install build
install_license LICENSE
"""

# C++20, and processors with run-time dispatch by GCC.
platforms = expand_cxxstring_abis([
    Platform("x86_64", "linux"; libc = "glibc"),
    Platform("aarch64", "linux"; libc = "glibc"),
])
products = [LibraryProduct("libwfpsf", :libwfpsf)]
dependencies = [
    Dependency("FFTW_jll"),
    Dependency("CFITSIO_jll"),
    Dependency("ERFA_jll"),
    Dependency("Zlib_jll"),
    BuildDependency("Eigen_jll"),
]
build_tarballs(ARGS, name, version, sources, script, platforms, products, dependencies;
               julia_compat = "1.6", preferred_gcc_version = v"12")
