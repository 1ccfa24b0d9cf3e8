# SPDX-License-Identifier: GPL-3.0-or-later

study = Study(Instrument(), 7; eps = 1e-4)
bands_of_study = study_table(study, :bands)
@test bands_of_study.band == bands(Instrument())
@test bands_of_study.effective_nm ≈ bands_of_study.paper_effective_nm rtol = 1e-5
for name in keys(Wfpsf.STUDY_TABLES)
    columns = study_table(study, name)
    @test length(columns) > 1
    @test all(length(column) == length(columns[1]) > 0 for column in columns)
end
@test_throws ArgumentError study_table(study, :figure_2)
mktempdir() do folder
    write_csv(study, folder)
    @test length(readdir(folder)) == length(Wfpsf.STUDY_TABLES)
end
@test_throws WfpsfError write_csv(study, "no/such/folder")
@test_throws WfpsfError Study(Instrument(), 19)
close(study)
