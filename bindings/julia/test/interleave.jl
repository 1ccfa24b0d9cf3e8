# SPDX-License-Identifier: GPL-3.0-or-later

# Pixel (x, y) of the dither by (dx, dy) shows the scene at (x + dx, y + dy).
scene(x, y) = 3x + 50y
dx = [i / 2 for i = 0:1, j = 0:2]
dy = [j / 3 for i = 0:1, j = 0:2]
images = [Image([scene(x + dx[k], y + dy[k]) for x = 1:4, y = 1:5]) for k in CartesianIndices(dx)]

fine = interleave(images, dx, dy)
@test fine.pixels ≈ [scene(1 + (i - 1) / 2, 1 + (j - 1) / 3) for i = 1:8, j = 1:15]
@test [image.pixels for image in deinterleave(fine, dx, dy)] == [image.pixels for image in images]
shuffled(matrix) = reshape(matrix[[5, 2, 1, 6, 3, 4]], 2, 3)
@test interleave(shuffled(images), shuffled(dx), shuffled(dy)).pixels == fine.pixels
@test_throws DimensionMismatch interleave(images, dx, dy')
@test status_of(() -> interleave(images, zero(dx), dy)) == LibWfpsf.WFPSF_ERROR_ARGUMENT
