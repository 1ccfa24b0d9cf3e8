# SPDX-License-Identifier: GPL-3.0-or-later

@test Wfpsf.version() == VersionNumber(LibWfpsf.WFPSF_VERSION_MAJOR, LibWfpsf.WFPSF_VERSION_MINOR,
                                       LibWfpsf.WFPSF_VERSION_PATCH)
@test isempty(detect_ambiguities(Wfpsf))

@testset "closing" begin
    instrument = Instrument()
    @test isopen(instrument)
    close(instrument)
    close(instrument)
    @test !isopen(instrument)
    @test_throws ArgumentError("the Instrument has been closed") bands(instrument)

    kept = Ref{Any}()
    @test Instrument(handle -> (kept[] = handle; 42)) == 42
    @test !isopen(kept[])
    @test_throws ErrorException Instrument(handle -> (kept[] = handle; error("inside")))
    @test !isopen(kept[])
end

@testset "errors" begin
    failure = try
        Instrument("hubble")
    catch e
        e
    end
    @test failure isa WfpsfError
    @test failure.code == LibWfpsf.WFPSF_ERROR_UNKNOWN_NAME
    @test occursin("hubble", failure.message)
    @test occursin("WFPSF_ERROR_UNKNOWN_NAME", sprint(showerror, failure))
end

@testset "collection" begin
    instrument = Instrument()
    for _ = 1:20
        PSF(instrument, 1, 1500; eps = 1e-2, psf_radius = 1)
        IPCKernel(0.01)
        draw(PSF(instrument, 1, 1500; eps = 1e-2, psf_radius = 1), 3, 3)
    end
    GC.gc()
    @test isopen(instrument)

    # An image keeps the matrix that it wraps.
    image = Image(ones(300, 300))
    GC.gc()
    foreach(_ -> fill(NaN, 300, 300), 1:10)
    @test unweighted_moments(image).flux == 300^2
end
