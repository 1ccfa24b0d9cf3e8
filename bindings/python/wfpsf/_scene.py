# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes: the stars and galaxies of a catalogue on an image, within an error budget; exposures."""
import collections
import ctypes

import numpy as np

from . import _lib
from ._handle import Handle, Properties, get, text_from
from ._image import as_image, writable, zeros
from ._library import lib
from ._names import address, choose, constants_of, integer, integers, of_one_length, text
from ._options import chosen
from ._status import check

POSITIONS = constants_of("WFPSF_POSITIONS_")
BRIGHTNESS = constants_of("WFPSF_BRIGHTNESS_")
GROUP = constants_of("WFPSF_SCENE_GROUP_")
RENDERING = constants_of("WFPSF_RENDERING_")
TRUTH = {name: column for name, column in constants_of("WFPSF_TRUTH_").items() if name != "columns"}
# What numbers of a group stand for; all others are numbers.
GROUP_WORDS = {"kind": {value: name for name, value in constants_of("WFPSF_KIND_").items()},
               "drawing": {value: name for name, value in constants_of("WFPSF_DRAWING_").items()},
               "colour": int, "sources": int}

SCENE_OPTIONS = ("scene_noise", "scene_variance", "scene_flux", "scene_background", "exposure_time",
                 "struts", "piston_tilt", "frame", "field_rule", "jitter_xx", "jitter_xy",
                 "jitter_yy", "charge_diffusion", "zernikes", "opd", "scene_store",
                 "scene_exposures")
RENDER_OPTIONS = ("threads", "memory_limit", "progress", "force")
TRUTH_OPTIONS = ("eps", "moments_tolerance", "threads")
EXPOSURE_OPTIONS = SCENE_OPTIONS + ("seed", "stream", "noise")
MAKE_OPTIONS = ("fits_overwrite", "threads", "memory_limit", "progress")

Rendering = collections.namedtuple("Rendering", RENDERING)
Rendering.__doc__ = """What rendering a scene came to.

time : wall-clock time, s
time_models, time_shared, time_own, time_galaxies : the parts of it that went into PSFs of the whole
    detector, sources drawn with those, sources with PSFs of their own, and galaxies drawn by
    Fourier transform
drawn : sources whose stamps reach the image
exact_psfs : that were made
error_estimate : how far a pixel may be off, e-, by the PSFs as they came out
"""


class Catalogue(Handle):
    """The stars and small galaxies that a scene is made of. Threads may share it once nothing is
    added to it any more.

    Parameters
    ----------
    positions : str
        "sky": x is RA and y is Dec, degrees, ICRS; "detector": pixels of a detector, the first
        one's centre at (0, 0).
    brightness : str
        "electrons": in the exposure, all of the source's light; "ab_magnitude": in the band.

    ``len(catalogue)`` is the number of sources; they are numbered from 0 in the order of adding.

    >>> catalogue = Catalogue("detector", "electrons")
    >>> catalogue.add_stars([100, 2000.3], [1000, 1500], [5e4, 300])
    >>> len(catalogue)
    2
    """

    _kind = _lib.wfpsf_catalogue_p
    _destroy = "wfpsf_catalogue_destroy"

    def __init__(self, positions, brightness):
        self._make(lambda out: lib.wfpsf_catalogue_create(
            choose(POSITIONS, "positions", positions), choose(BRIGHTNESS, "brightness", brightness),
            out))

    def __len__(self):
        count = ctypes.c_int64()
        check(lib.wfpsf_catalogue_size(self, count))
        return count.value

    def add_colour(self, wavelength_nm=0.0, sed=None):
        """Adds a colour that sources may have and returns its number: one wavelength (0: the band's
        effective one), or the light of an :class:`SED` seen through the band. Sources of one colour
        share PSFs, so a few that stand for all are better than one for each. A catalogue without
        any has one, number 0: that of wavelength 0."""
        colour = ctypes.c_int32()
        check(lib.wfpsf_catalogue_add_colour(self, wavelength_nm, sed, colour))
        return colour.value

    def add_stars(self, x, y, brightness, colour=None):
        """Adds stars, by three arrays of one length. ``colour`` is the number of the colour of all,
        or an array of those of each; None: 0. Those that lie far off any detector do no harm."""
        x, y, brightness = of_one_length(x=x, y=y, brightness=brightness)
        colour = _colours(colour, len(x))
        check(lib.wfpsf_catalogue_add_stars(self, len(x), x.ctypes.data, y.ctypes.data,
                                            brightness.ctypes.data, address(colour)))

    def add_galaxies(self, x, y, brightness, colour=None, *, sersic_index,
                     half_light_radius_arcsec, e1=None, e2=None):
        """Adds galaxies: Sersic profiles, by arrays of one length, sheared without change of area
        and cut off nowhere.

        Indices are 0.3 to 6.2 (0.5: Gaussian, 1: exponential, 4: de Vaucouleurs), radii those
        before the shear. (e1, e2) is (a - b) / (a + b) times cosine and sine of twice the angle of
        the major axis from x towards y of the detector, up to 0.95 in all; None: 0. The rest is as
        for :meth:`add_stars`, the positions being those of the centres.
        """
        x, y, brightness, index, radius = of_one_length(
            x=x, y=y, brightness=brightness, sersic_index=sersic_index,
            half_light_radius_arcsec=half_light_radius_arcsec)
        colour = _colours(colour, len(x))
        e1, e2 = (None if e is None else of_one_length(x=x, **{name: e})[1]
                  for name, e in (("e1", e1), ("e2", e2)))
        check(lib.wfpsf_catalogue_add_galaxies(
            self, len(x), x.ctypes.data, y.ctypes.data, brightness.ctypes.data, address(colour),
            index.ctypes.data, radius.ctypes.data, address(e1), address(e2)))


def _colours(colour, count):
    """The number of each source's colour; None: 0 for all."""
    if colour is None:
        return None
    if np.ndim(colour) == 0:
        return np.full(count, integer("colour", colour, 32), dtype=np.int32)
    found = integers("colour", colour, 32)
    if len(found) != count:
        raise ValueError("colour has %d elements for %d sources" % (len(found), count))
    return found


class SceneStore(Handle):
    """What scenes are drawn with, kept for the next ones: PSFs of a whole detector and tables of far
    light. Scenes of the same optics and image that are made with ``scene_store=store`` plan with
    what is there: from the second exposure of a detector on, most of the time is saved. The option
    ``scene_exposures`` tells plans how many scenes will share what they make, which may then take
    as many times as long. How a scene is drawn, within its budget, depends on what the store holds.
    Threads may share it.

    >>> from wfpsf import Instrument
    >>> roman, store = Instrument("roman-c9"), SceneStore()
    >>> made = []
    >>> for exposure in range(2):
    ...     stars = Catalogue("detector", "electrons")
    ...     stars.add_stars([2010, 2040], [2010, 2030 + exposure], [1e4, 300])
    ...     scene = Scene(roman, "J129", 7, stars, (64, 64), 2000, 2000, scene_store=store,
    ...                   scene_exposures=100)
    ...     made.append(scene.render(zeros((64, 64))).exact_psfs)
    >>> made[0] > 0, made[1]
    (True, 0.0)
    """

    _kind = _lib.wfpsf_scene_store_p
    _destroy = "wfpsf_scene_store_destroy"

    def __init__(self):
        self._make(lib.wfpsf_scene_store_create)

    @property
    def memory(self):
        """Bytes that it holds, about."""
        held = ctypes.c_int64()
        check(lib.wfpsf_scene_store_memory(self, held))
        return held.value

    def write(self, path):
        """Writes what it holds to a file, for other processes: a detector's first scene then takes no
        longer than its further ones. The file takes the place of one that is there, and is for this
        version of the library on machines of this kind alone."""
        check(lib.wfpsf_scene_store_write(self, text("path", path)))

    def read(self, path):
        """Adds what such a file holds."""
        check(lib.wfpsf_scene_store_read(self, text("path", path)))


class Scene(Properties, Handle):
    """All sources of a catalogue on an image of detector ``sca``, each modelled as far as an error
    budget needs. Immutable: threads may share it, each with its own image. What it was made of may
    be closed or changed afterwards.

    The budget is ``scene_noise``: how far a pixel may be off, in units of its noise, the square
    root of ``scene_variance``; the sources' own noise is not counted. A scene first plans: sources
    of one colour and kind whose fluxes are within a factor of two form a group, and every group is
    drawn in the way that costs least in all within the budget. ``str(scene)`` is the plan, a line a
    group.

    Parameters
    ----------
    instrument : Instrument
    band : str
    sca : int
        Detector, from 1.
    catalogue : Catalogue
    image : Image, array or (ny, nx)
        What it is planned for: size and oversampling. It is not touched.
    x0, y0 : float
        Where the centre of the image's first native pixel stands on the detector, whose first
        pixel's is (0, 0).
    observation : Observation, optional
        For positions on the sky.
    options
        scene_noise, scene_variance, scene_flux, scene_background, exposure_time (for magnitudes);
        scene_store, a :class:`SceneStore`, and scene_exposures; struts, piston_tilt, frame,
        field_rule, jitter_xx, jitter_xy, jitter_yy, charge_diffusion, zernikes and opd as for
        :class:`PSF`; threads, on which no bit depends.

    Attributes: sources (that have a place on the detector or around it), error_allowed and
    error_expected (how far a pixel may be off, and may come to be off, e-), time_expected (of
    rendering with one thread, s, to a factor of two), memory_expected (bytes).

    >>> from wfpsf import Instrument
    >>> catalogue = Catalogue("detector", "electrons")
    >>> catalogue.add_stars([2010, 2040], [2010, 2030], [1e5, 300])
    >>> scene = Scene(Instrument("roman-c9"), "J129", 7, catalogue, (64, 64), 2000, 2000)
    >>> scene.groups[0]["kind"], scene.groups_of_sources.tolist()
    ('star', [0, 1])
    >>> image = zeros((64, 64))
    >>> scene.render(image).error_estimate < scene.error_allowed
    True
    """

    _kind = _lib.wfpsf_scene_p
    _destroy = "wfpsf_scene_destroy"
    _getter = "wfpsf_scene_get"
    _properties = {name: key for name, key in constants_of("WFPSF_SCENE_").items()
                   if not name.startswith("group")}

    def __init__(self, instrument, band, sca, catalogue, image, x0=0.0, y0=0.0, observation=None,
                 **options):
        image = zeros(image) if isinstance(image, tuple) else as_image(image)
        self._size = len(catalogue)
        with chosen(SCENE_OPTIONS + ("threads",), options) as handle:
            self._make(lambda out: lib.wfpsf_scene_create(
                instrument, observation, text("band", band), integer("sca", sca, 32), catalogue,
                image, x0, y0, handle, out))

    @property
    def groups(self):
        """The groups as planned: a list of dicts of colour (its number in the catalogue), kind
        ("star" or "galaxy"), flux_from (the sources have this flux or more, up to twice as much,
        e-), sources (how many), drawing ("shared": stars by a model of the whole detector's PSF,
        "own": stars by a PSF made for each, "fourier": galaxies), radius (half size of the stamps,
        native pixels), eps (error of the PSF, in units of its peak), far_floor (light beyond the
        stamp is drawn down to that share of it; 0: none is), error_expected (how far the group may
        bring a pixel off, e-), time_expected (s)."""
        count = int(get(lib.wfpsf_scene_get, self, _lib.WFPSF_SCENE_GROUPS))
        return [self._group(group) for group in range(count)]

    def _group(self, group):
        value, found = ctypes.c_double(), {}
        for name, key in GROUP.items():
            check(lib.wfpsf_scene_get_group(self, group, key, value))
            meaning = GROUP_WORDS.get(name, float)
            found[name] = (meaning[value.value] if isinstance(meaning, dict)
                           else meaning(value.value))
        return found

    @property
    def groups_of_sources(self):
        """Which source got what: an array of the number in ``groups`` of each source of the
        catalogue; -1: it has no place."""
        groups = np.empty(self._size, dtype=np.int32)
        check(lib.wfpsf_scene_groups_of(self, len(groups), groups.ctypes.data))
        return groups

    def __str__(self):
        return text_from(lambda *to: lib.wfpsf_scene_text(self, *to))

    def render(self, image, **options):
        """Adds all sources to an image of the size and oversampling that the scene was planned for.
        Its pixels are electrons. Returns a :class:`Rendering`, named numbers. Options: threads
        (which changes the time and no bit of the result), memory_limit, progress, force."""
        image, out = writable(image), _lib.wfpsf_rendering_p()
        with chosen(RENDER_OPTIONS, options) as handle:
            try:
                check(lib.wfpsf_scene_render(self, handle, image, ctypes.byref(out)))
                return Rendering(*(get(lib.wfpsf_rendering_get, out, key)
                                   for key in RENDERING.values()))
            finally:
                lib.wfpsf_rendering_destroy(out)

    def truth(self, sources=None, kernel=None, **options):
        """What is true of some sources, by their numbers in the catalogue; None: of all. About
        0.2 ms a star.

        A dict of columns, arrays: group (-1: the source has no place), position_x, position_y (on
        the detector, pixels), flux (e-, all of it), flux_in_stamp, and adaptive moments of each
        source as it is seen through its PSF and pixel, without noise and neighbours: status,
        centroid_x, centroid_y (on the detector), sigma (native pixels), e1, e2, and with a
        ``kernel`` of native pixels ipc_centroid_x ... ipc_e2, after interpixel capacitance. NaN
        where there is no answer. Options: eps (of the PSFs), moments_tolerance, threads.
        """
        asked = None if sources is None else integers("sources", sources)
        rows = np.empty((self._size if asked is None else len(asked), _lib.WFPSF_TRUTH_COLUMNS))
        with chosen(TRUTH_OPTIONS, options) as handle:
            check(lib.wfpsf_scene_truth(self, len(rows), address(asked), kernel, handle,
                                        rows.ctypes.data))
        columns = {name: rows[:, column].copy() for name, column in TRUTH.items()}
        columns["group"] = columns["group"].astype(np.int32)
        return columns


class Exposure(Handle):
    """The scenes of all detectors of a focal plane, with background and detector effects, each in a
    FITS file of its own. Immutable: threads may make detectors of one.

    A file appears whole or not at all, and carries a fingerprint of all that it was made of: a
    program that was broken off is run again, and nothing is made twice. Detectors may be shared out
    among programs and machines in any way; the files are the same.

    Parameters
    ----------
    instrument, observation, band, catalogue
        As for :class:`Scene`.
    chain : Chain, optional
        What the detectors do, after ``scene_background`` is added; None: nothing, files hold the
        mean electrons of sources and background.
    options
        Those of :class:`Scene`, seed, stream (the exposure's number, which goes into file names and
        noise) and noise.

    >>> from wfpsf import Instrument, Observation
    >>> roman, catalogue = Instrument("roman-c9"), Catalogue("sky", "ab_magnitude")
    >>> catalogue.add_stars([59.9], [-30], [20])
    >>> exposure = Exposure(roman, Observation(roman, 60, -30, 30), "J129", catalogue, stream=1)
    >>> exposure.path("folder", 7)
    'folder/exposure_00001_sca07.fits'
    """

    _kind = _lib.wfpsf_exposure_p
    _destroy = "wfpsf_exposure_destroy"

    def __init__(self, instrument, observation, band, catalogue, chain=None, **options):
        with chosen(EXPOSURE_OPTIONS, options) as handle:
            self._make(lambda out: lib.wfpsf_exposure_create(
                instrument, observation, text("band", band), catalogue, chain, handle, out))

    def path(self, folder, sca):
        """The path of a detector's file."""
        folder, sca = text("folder", folder), integer("sca", sca, 32)
        return text_from(lambda *to: lib.wfpsf_exposure_path(self, folder, sca, *to))

    def make(self, sca, folder, **options):
        """Makes a detector's file in a folder that exists. False: it was there, made of the same.
        One that was made of other things is an error, unless fits_overwrite is 1. Options:
        fits_overwrite, threads, memory_limit, progress."""
        made = ctypes.c_int32()
        with chosen(MAKE_OPTIONS, options) as handle:
            check(lib.wfpsf_exposure_make(self, integer("sca", sca, 32), text("folder", folder),
                                          handle, made))
        return made.value == 1
