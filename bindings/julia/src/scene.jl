# SPDX-License-Identifier: GPL-3.0-or-later

kept(test, table) = NamedTuple{Tuple(filter(test, collect(keys(table))))}(table)

const CATALOGUE_POSITIONS = constants_of("WFPSF_POSITIONS_")
const CATALOGUE_BRIGHTNESS = constants_of("WFPSF_BRIGHTNESS_")
const SCENE_PROPERTIES = kept(name -> !startswith(String(name), "group_"),
                              constants_of("WFPSF_SCENE_"))
const GROUP_PROPERTIES = constants_of("WFPSF_SCENE_GROUP_")
const SOURCE_KINDS = constants_of("WFPSF_KIND_")
const SOURCE_DRAWINGS = constants_of("WFPSF_DRAWING_")
const RENDERING_PROPERTIES = constants_of("WFPSF_RENDERING_")
const TRUTH_COLUMNS = kept(!=(:columns), constants_of("WFPSF_TRUTH_"))

const SCENE_OPTIONS = (:scene_noise, :scene_variance, :scene_flux, :scene_background,
                       :exposure_time, :struts, :piston_tilt, :frame, :field_rule, :jitter_xx,
                       :jitter_xy, :jitter_yy, :charge_diffusion, :zernikes, :opd, :scene_store,
                       :scene_exposures)
const RENDER_OPTIONS = (:threads, :memory_limit, :progress, :force)
const TRUTH_OPTIONS = (:eps, :moments_tolerance, :threads)
const EXPOSURE_OPTIONS = (SCENE_OPTIONS..., :seed, :stream, :noise)
const MAKE_OPTIONS = (:fits_overwrite, :threads, :memory_limit, :progress)

"""
    Catalogue(positions, brightness)
    Catalogue(f, ...)

The stars and small galaxies that a scene is made of. `positions` is `:sky` (x is RA and y is Dec,
degrees, ICRS) or `:detector` (pixels of a detector, the first one's centre at (1, 1));
`brightness` is `:electrons` (in the exposure, all of the source's light) or `:ab_magnitude` (in the
band). Threads may share it once nothing is added to it any more.

[`add_colour!`](@ref), [`add_stars!`](@ref) and [`add_galaxies!`](@ref) fill it; `length(catalogue)`
is the number of sources, which are numbered from 1 in the order of adding.

```jldoctest
julia> catalogue = Catalogue(:detector, :electrons);

julia> add_stars!(catalogue, [101, 2001.3], [1001, 1501], [5e4, 300]);

julia> length(catalogue)
2
```
"""
mutable struct Catalogue <: Handle
    pointer::Ptr{Cvoid}
    origin::Float64 # positions count from 1 here, from 0 in the library; RA and Dec are the same

    function Catalogue(positions::Symbol, brightness::Symbol)
        pointer = created() do out
            LibWfpsf.wfpsf_catalogue_create(
                choose(CATALOGUE_POSITIONS, :positions, positions),
                choose(CATALOGUE_BRIGHTNESS, :brightness, brightness), out)
        end
        return finalizer(close, new(pointer, positions === :detector ? 1 : 0))
    end
end

destroy(::Catalogue, pointer) = LibWfpsf.wfpsf_catalogue_destroy(pointer)

function Base.length(catalogue::Catalogue)
    count = Ref{Int64}()
    check(LibWfpsf.wfpsf_catalogue_size(catalogue, count))
    return count[]
end

"""
    add_colour!(catalogue; wavelength_nm = 0)
    add_colour!(catalogue, sed)

Adds a colour that sources may have and returns its number, from 1: one wavelength (0: the band's
effective one), or the light of an [`SED`](@ref) seen through the band. Sources of one colour share
PSFs, so a few that stand for all are better than one for each. A catalogue without any has one,
number 1: that of wavelength 0.
"""
add_colour!(catalogue::Catalogue; wavelength_nm::Real = 0) =
    add_colour(catalogue, wavelength_nm, C_NULL)
add_colour!(catalogue::Catalogue, sed::SED) = add_colour(catalogue, 0, sed)

function add_colour(catalogue, wavelength_nm, sed)
    colour = Ref{Int32}()
    check(LibWfpsf.wfpsf_catalogue_add_colour(catalogue, wavelength_nm, sed, colour))
    return Int(colour[]) + 1
end

# The arguments as vectors for the library, when they have one length.
function of_one_length(; columns...)
    lengths = map(length, values(columns))
    all(==(first(lengths)), lengths) || throw(DimensionMismatch(
        "$(join(keys(columns), ", ")) must have one length, not $(join(lengths, ", "))"))
    return map(column -> Vector{Float64}(column), Tuple(values(columns)))
end

# The number of each source's colour, from 0.
colours_of(::Nothing, count) = C_NULL
colours_of(colour::Integer, count) = fill(Int32(colour - 1), count)

function colours_of(colour::AbstractVector{<:Integer}, count)
    length(colour) == count || throw(DimensionMismatch(
        "colour has $(length(colour)) elements for $count sources"))
    return Int32[number - 1 for number in colour]
end

"""
    add_stars!(catalogue, x, y, brightness; colour = nothing)

Adds stars to a [`Catalogue`](@ref), by three vectors of one length. `colour` is the number of the
colour of all, or a vector of those of each; `nothing`: the first. Those that lie far off any
detector do no harm.
"""
function add_stars!(catalogue::Catalogue, x::AbstractVector{<:Real}, y::AbstractVector{<:Real},
                    brightness::AbstractVector{<:Real}; colour = nothing)
    xs, ys, values = of_one_length(x = x, y = y, brightness = brightness)
    check(LibWfpsf.wfpsf_catalogue_add_stars(catalogue, length(xs), xs .- catalogue.origin,
                                             ys .- catalogue.origin, values,
                                             colours_of(colour, length(xs))))
    return catalogue
end

"""
    add_galaxies!(catalogue, x, y, brightness; sersic_index, half_light_radius_arcsec,
                  e1 = nothing, e2 = nothing, colour = nothing)

Adds galaxies to a [`Catalogue`](@ref): Sersic profiles, by vectors of one length, sheared without
change of area and cut off nowhere.

Indices are 0.3 to 6.2 (0.5: Gaussian, 1: exponential, 4: de Vaucouleurs), radii those before the
shear. (`e1`, `e2`) is (a - b) / (a + b) times cosine and sine of twice the angle of the major axis
from x towards y of the detector, up to 0.95 in all; `nothing`: 0. The rest is as for stars, the
positions being those of the centres.
"""
function add_galaxies!(catalogue::Catalogue, x::AbstractVector{<:Real}, y::AbstractVector{<:Real},
                       brightness::AbstractVector{<:Real};
                       sersic_index::AbstractVector{<:Real},
                       half_light_radius_arcsec::AbstractVector{<:Real}, e1 = nothing, e2 = nothing,
                       colour = nothing)
    round_ones = zeros(length(x))
    xs, ys, values, indices, radii, e1s, e2s = of_one_length(
        x = x, y = y, brightness = brightness, sersic_index = sersic_index,
        half_light_radius_arcsec = half_light_radius_arcsec,
        e1 = e1 === nothing ? round_ones : e1, e2 = e2 === nothing ? round_ones : e2)
    check(LibWfpsf.wfpsf_catalogue_add_galaxies(
        catalogue, length(xs), xs .- catalogue.origin, ys .- catalogue.origin, values,
        colours_of(colour, length(xs)), indices, radii, e1s, e2s))
    return catalogue
end

"""
    ab_zero_rate(instrument, band)

Electrons a second that a source of AB magnitude 0 gives in a band, e-/s.
"""
function ab_zero_rate(instrument::Instrument, band::AbstractString)
    rate = Ref{Float64}()
    check(LibWfpsf.wfpsf_instrument_ab_zero_rate(instrument, band, rate))
    return rate[]
end

"""
    SceneStore()
    SceneStore(f)

What scenes are drawn with, kept for the next ones: PSFs of a whole detector and tables of far
light. Scenes of the same optics and image that are made with the option `scene_store = store` plan
with what is there: from the second exposure of a detector on, most of the time is saved. The option
`scene_exposures` tells plans how many scenes will share what they make, which may then take as many
times as long. How a scene is drawn, within its budget, depends on what the store holds. Threads may
share it.

Its one property is `memory`: bytes that it holds, about.
"""
mutable struct SceneStore <: Handle
    pointer::Ptr{Cvoid}
    SceneStore() = finalizer(close, new(created(LibWfpsf.wfpsf_scene_store_create)))
end

destroy(::SceneStore, pointer) = LibWfpsf.wfpsf_scene_store_destroy(pointer)

Base.propertynames(::SceneStore) = (:memory,)

function Base.getproperty(store::SceneStore, name::Symbol)
    name === :memory || throw(ArgumentError("no property $name here: there is memory"))
    held = Ref{Int64}()
    check(LibWfpsf.wfpsf_scene_store_memory(store, held))
    return held[]
end

"""
    write_scene_store(path, store)

Writes what a [`SceneStore`](@ref) holds to a file, for other processes: a detector's first scene
then takes no longer than its further ones. The file takes the place of one that is there, and is
for this version of the library on machines of this kind alone.
"""
function write_scene_store(path::AbstractString, store::SceneStore)
    check(LibWfpsf.wfpsf_scene_store_write(store, path))
end

"""
    read_scene_store!(store, path)

Adds what such a file holds to a [`SceneStore`](@ref), and returns it.
"""
function read_scene_store!(store::SceneStore, path::AbstractString)
    check(LibWfpsf.wfpsf_scene_store_read(store, path))
    return store
end

"""
    Scene(instrument, band, sca, catalogue, image, x0 = 1, y0 = 1; observation = nothing,
          options...)
    Scene(f, ...)

All sources of a [`Catalogue`](@ref) on an image of detector `sca`, each modelled as far as an error
budget needs. Immutable: threads may share it, each with its own image. What it was made of may be
closed or changed afterwards.

The budget is `scene_noise`: how far a pixel may be off, in units of its noise, the square root of
`scene_variance`; the sources' own noise is not counted. A scene first plans: sources of one colour
and kind whose fluxes are within a factor of two form a group, and every group is drawn in the way
that costs least in all within the budget. `string(scene)` is the plan, a line a group;
[`scene_groups`](@ref) and [`groups_of_sources`](@ref) tell it in numbers, [`render!`](@ref) carries
it out, [`scene_truth`](@ref) says what is true of its sources.

`image` is an [`Image`](@ref), of which size and oversampling count, or `(nx, ny)`; (x0, y0) is
where the centre of its first native pixel stands on the detector, whose first pixel's is (1, 1).
`observation` is for positions on the sky. Options: `scene_noise`, `scene_variance`, `scene_flux`,
`scene_background`, `exposure_time` (for magnitudes); `scene_store`, a [`SceneStore`](@ref), and
`scene_exposures`; `struts`, `piston_tilt`, `frame`, `field_rule`, `jitter_xx`, `jitter_xy`,
`jitter_yy`, `charge_diffusion`, `zernikes` and `opd` as for [`PSF`](@ref); `threads`, on which no
bit depends.

Properties: `sources` (that have a place on the detector or around it), `groups` (how many),
`error_allowed` and `error_expected` (how far a pixel may be off, and may come to be off, e-),
`time_expected` (of rendering with one thread, s, to a factor of two), `memory_expected` (bytes).

```jldoctest
julia> catalogue = Catalogue(:detector, :electrons);

julia> add_stars!(catalogue, [2011, 2041], [2011, 2031], [1e5, 300]);

julia> scene = Scene(Instrument("roman-c9"), "J129", 7, catalogue, (64, 64), 2001, 2001);

julia> groups_of_sources(scene)
[1, 2]

julia> render!(Image(Float64, 64, 64), scene).error_estimate < scene.error_allowed
true
```
"""
mutable struct Scene <: Handle
    pointer::Ptr{Cvoid}
    count::Int64 # of sources of the catalogue

    function Scene(instrument::Instrument, band::AbstractString, sca::Integer, catalogue::Catalogue,
                   image::Image, x0::Real = 1, y0::Real = 1; observation = nothing, keywords...)
        pointer = with_options((SCENE_OPTIONS..., :threads), keywords) do options
            created() do out
                LibWfpsf.wfpsf_scene_create(instrument, or_null(observation), band, sca, catalogue,
                                            image, x0 - 1, y0 - 1, options, out)
            end
        end
        return finalizer(close, new(pointer, length(catalogue)))
    end
end

Scene(instrument::Instrument, band::AbstractString, sca::Integer, catalogue::Catalogue,
      size::Tuple{Integer,Integer}, x0::Real = 1, y0::Real = 1; keywords...) =
    Scene(instrument, band, sca, catalogue, Image(Float64, size...), x0, y0; keywords...)

destroy(::Scene, pointer) = LibWfpsf.wfpsf_scene_destroy(pointer)

Base.propertynames(::Scene) = keys(SCENE_PROPERTIES)

function Base.getproperty(scene::Scene, name::Symbol)
    value = Ref{Float64}()
    check(LibWfpsf.wfpsf_scene_get(scene, choose(SCENE_PROPERTIES, :property, name), value))
    return value[]
end

Base.print(io::IO, scene::Scene) =
    print(io, text_from((text...) -> LibWfpsf.wfpsf_scene_text(scene, text...)))

"""
    scene_groups(scene)

The groups as planned: a vector of named tuples of `colour` (its number in the catalogue), `kind`
(`:star` or `:galaxy`), `flux_from` (the sources have this flux or more, up to twice as much, e-),
`sources` (how many), `drawing` (`:shared`: stars by a model of the whole detector's PSF, `:own`:
stars by a PSF made for each, `:fourier`: galaxies), `radius` (half size of the stamps, native
pixels), `eps` (error of the PSF, in units of its peak), `far_floor` (light beyond the stamp is
drawn down to that share of it; 0: none is), `error_expected` (how far the group may bring a pixel
off, e-), `time_expected` (s).
"""
scene_groups(scene::Scene) = [group_of(scene, group) for group = 1:Int(scene.groups)]

function group_of(scene, group)
    found = map(GROUP_PROPERTIES) do key
        value = Ref{Float64}()
        check(LibWfpsf.wfpsf_scene_get_group(scene, group - 1, key, value))
        value[]
    end
    word(table, value) = keys(table)[findfirst(==(value), values(table))]
    return merge(found, (colour = Int(found.colour) + 1, kind = word(SOURCE_KINDS, found.kind),
                         sources = Int(found.sources),
                         drawing = word(SOURCE_DRAWINGS, found.drawing)))
end

"""
    groups_of_sources(scene)

Which source got what: the number of the group of each source of the catalogue, from 1; 0: it has no
place.
"""
function groups_of_sources(scene::Scene)
    group = Vector{Int32}(undef, getfield(scene, :count))
    check(LibWfpsf.wfpsf_scene_groups_of(scene, length(group), group))
    return Int.(group) .+ 1
end

"""
    render!(image, scene; options...)

Adds all sources of a [`Scene`](@ref) to an image of the size and oversampling that it was planned
for. Its pixels are electrons. Options: `threads` (which changes the time and no bit of the result),
`memory_limit`, `progress`, `force`.

Returns what it came to: `time` (wall-clock, s), `time_models`, `time_shared`, `time_own`,
`time_galaxies` (the parts of it that went into PSFs of the whole detector, sources drawn with
those, sources with PSFs of their own, galaxies drawn by Fourier transform), `drawn` (sources whose
stamps reach the image), `exact_psfs` (that were made), `error_estimate` (how far a pixel may be
off, e-, by the PSFs as they came out).
"""
function render!(image::Image, scene::Scene; keywords...)
    rendering = with_options(RENDER_OPTIONS, keywords) do options
        created(out -> LibWfpsf.wfpsf_scene_render(scene, options, image, out))
    end
    try
        return map(RENDERING_PROPERTIES) do key
            value = Ref{Float64}()
            check(LibWfpsf.wfpsf_rendering_get(rendering, key, value))
            value[]
        end
    finally
        LibWfpsf.wfpsf_rendering_destroy(rendering)
    end
end

"""
    scene_truth(scene, sources = 1:n; kernel = nothing, options...)

What is true of some sources, by their numbers in the catalogue, by default of all. About 0.2 ms a
star.

A named tuple of vectors: `group` (0: the source has no place), `position_x`, `position_y` (on the
detector, pixels), `flux` (e-, all of it), `flux_in_stamp`, and adaptive moments of each source as
it is seen through its PSF and pixel, without noise and neighbours: `status`, `centroid_x`,
`centroid_y` (on the detector), `sigma` (native pixels), `e1`, `e2`, and with a `kernel` of native
pixels `ipc_centroid_x` ... `ipc_e2`, after interpixel capacitance. NaN where there is no answer.
Options: `eps` (of the PSFs), `moments_tolerance`, `threads`.
"""
function scene_truth(scene::Scene,
                     sources::AbstractVector{<:Integer} = 1:getfield(scene, :count);
                     kernel = nothing, keywords...)
    asked = Int64[source - 1 for source in sources]
    values = Matrix{Float64}(undef, LibWfpsf.WFPSF_TRUTH_COLUMNS, length(asked))
    with_options(TRUTH_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_scene_truth(scene, length(asked), asked, or_null(kernel), options,
                                         values))
    end
    columns = map(column -> values[column + 1, :], TRUTH_COLUMNS)
    places = (:position_x, :position_y, :centroid_x, :centroid_y, :ipc_centroid_x, :ipc_centroid_y)
    moved = NamedTuple{places}(Tuple(columns[name] .+ 1 for name in places))
    return merge(columns, moved, (group = Int.(columns.group) .+ 1,))
end

"""
    Exposure(instrument, observation, band, catalogue; chain = nothing, options...)
    Exposure(f, ...)

The scenes of all detectors of a focal plane, with background and detector effects, each in a FITS
file of its own. Immutable: threads may make detectors of one.

A file appears whole or not at all, and carries a fingerprint of all that it was made of: a program
that was broken off is run again, and nothing is made twice. Detectors may be shared out among
programs and machines in any way; the files are the same.

`chain` is what the detectors do, after `scene_background` is added; `nothing`: nothing, files hold
the mean electrons of sources and background. Options: those of [`Scene`](@ref), `seed`, `stream`
(the exposure's number, which goes into file names and noise) and `noise`. [`make_exposure`](@ref)
makes a file, [`exposure_path`](@ref) tells its path.
"""
mutable struct Exposure <: Handle
    pointer::Ptr{Cvoid}

    function Exposure(instrument::Instrument, observation::Observation, band::AbstractString,
                      catalogue::Catalogue; chain = nothing, keywords...)
        return with_options(EXPOSURE_OPTIONS, keywords) do options
            finalizer(close, new(created() do out
                LibWfpsf.wfpsf_exposure_create(instrument, observation, band, catalogue,
                                               or_null(chain), options, out)
            end))
        end
    end
end

destroy(::Exposure, pointer) = LibWfpsf.wfpsf_exposure_destroy(pointer)

"""
    exposure_path(exposure, folder, sca)

The path of a detector's file, such as `"folder/exposure_00001_sca07.fits"`.
"""
exposure_path(exposure::Exposure, folder::AbstractString, sca::Integer) =
    text_from((text...) -> LibWfpsf.wfpsf_exposure_path(exposure, folder, sca, text...))

"""
    make_exposure(exposure, sca, folder; options...)

Makes a detector's file in a folder that exists. `false`: it was there, made of the same. One that
was made of other things is an error, unless `fits_overwrite` is 1. Options: `fits_overwrite`,
`threads`, `memory_limit`, `progress`.
"""
function make_exposure(exposure::Exposure, sca::Integer, folder::AbstractString; keywords...)
    made = Ref{Int32}()
    with_options(MAKE_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_exposure_make(exposure, sca, folder, options, made))
    end
    return made[] == 1
end
