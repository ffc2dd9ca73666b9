# SPDX-License-Identifier: BSD-3-Clause
"""Loads the plugin, chains its filters and looks at what comes out. Run by test.sh, under pvbatch.

    pvbatch test_plugin.py PLUGIN MESH OUTPUT

Leaves harmonic.png, distortion.png and spectrum.png in OUTPUT.
"""

import os
import sys
import tempfile
from pathlib import Path

from paraview import servermanager, smstate, smtrace
from paraview.simple import *

# The menu's filters, and the filters' classes.
FILTERS = ("ManifoldHarmonics", "ManifoldHarmonicsReconstruction", "ManifoldHarmonicsSimilarity",
           "EmbedSpectralWatermark", "DetectSpectralWatermark", "MeshAttack", "MeshDistortion")
SECRET = "a secret for the test"


def main(plugin, mesh_file, output):
    LoadPlugin(plugin, remote=False, ns=globals())
    folder = Path(output)
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile("w", suffix=".key") as key:
        key.write(SECRET)
        key.flush()
        check_documentation()
        model = OpenDataFile(mesh_file)
        check_harmonics(model, folder)
        check_watermark(model, key.name, folder)
        check_a_filter_runs_again_after_an_abort(model)
        check_nothing_shows_the_secret()
        check_a_trace_has_the_files_name_only(model, key.name)
        check_nothing_holds_the_secret(key.name, folder)
        check_macro(model, key.name)
    print("the plugin works")


def check_documentation():
    """Every filter is there, and every property of it says what it is."""
    for name in FILTERS:
        assert name in globals(), name  # what a script calls it
        proxy = servermanager.ProxyManager().GetPrototypeProxy("filters", PROXY[name])
        assert proxy.GetDocumentation().GetShortHelp(), name
        assert proxy.GetHints().FindNestedElementByName("ShowInMenu").GetAttribute(
            "category") == "Spectral Watermark", name
        properties = proxy.NewPropertyIterator()
        properties.Begin()
        count = 0
        while not properties.IsAtEnd():
            each = properties.GetProperty()
            assert each.GetDocumentation() and each.GetDocumentation().GetDescription().strip(), (
                name, properties.GetKey())
            assert properties.GetKey() != "SecretKey", name
            count += 1
            properties.Next()
        assert count >= 4, (name, count)


PROXY = {"EmbedSpectralWatermark": "SpectralWatermarkEmbed",
         "DetectSpectralWatermark": "SpectralWatermarkDetect",
         **{name: name for name in FILTERS if "Watermark" not in name}}


def check_harmonics(model, folder):
    harmonics = ManifoldHarmonics(Input=model, NumberOfHarmonics=60)
    harmonics.UpdatePipeline()
    assert harmonics.PointData["ManifoldHarmonics"].GetNumberOfComponents() == 60
    view = CreateView("RenderView", ViewSize=[900, 700])
    display = Show(harmonics, view)
    ColorBy(display, ("POINTS", "ManifoldHarmonics", "29"))
    display.RescaleTransferFunctionToDataRange(True)
    display.SetScalarBarVisibility(view, True)
    view.ResetCamera(True)
    SaveScreenshot(str(folder / "harmonic.png"), view, ImageResolution=(900, 700))

    chart = CreateView("XYChartView", ViewSize=[900, 600])
    shown = Show(OutputPort(harmonics, 1), chart, "XYChartRepresentation")
    shown.UseIndexForXAxis = 0
    shown.XArrayName = "Component"
    shown.SeriesVisibility = ["Magnitude"]
    chart.LeftAxisLogScale = 1
    chart.ChartTitle = "Spectrum"
    chart.BottomAxisTitle = "component"
    Render(chart)
    SaveScreenshot(str(folder / "spectrum.png"), chart, ImageResolution=(900, 600))

    smooth = ManifoldHarmonicsReconstruction(Input=harmonics, NumberOfHarmonics=30)
    smooth.UpdatePipeline()
    assert smooth.GetDataInformation().GetNumberOfPoints() == \
        harmonics.GetDataInformation().GetNumberOfPoints()
    similarity = ManifoldHarmonicsSimilarity(Reference=harmonics, Other=harmonics)
    similarity.UpdatePipeline()
    similarities = similarity.GetDataInformation(1).GetRowDataInformation()
    lowest = similarities.GetArrayInformation("Similarity").GetComponentRange(0)[0]
    assert abs(lowest - 1.0) < 1e-6, lowest


def check_watermark(model, key_file, folder):
    embed = EmbedSpectralWatermark(Input=model, SecretKeyFile=key_file)
    attack = MeshAttack(Input=OutputPort(embed, 0), Attack="Simplification",
                        SimplificationPercent=30.0)
    detect = DetectSpectralWatermark(Input=attack, SecretKeyFile=key_file)
    unmarked = DetectSpectralWatermark(Input=model, SecretKeyFile=key_file)
    distortion = MeshDistortion(Reference=model, Distorted=OutputPort(embed, 0))
    for each in (embed, attack, detect, unmarked, distortion):
        each.UpdatePipeline()
    assert result(embed, "Converged") == 1.0
    assert result(detect, "Detected") == 1.0 and result(detect, "PValue") < 1e-20
    assert result(unmarked, "Detected") == 0.0 and result(unmarked, "PValue") > 1e-6
    assert 0.0 < distortion.FieldData["MRMS"].GetRange()[0] < 0.0008

    view = CreateView("RenderView", ViewSize=[900, 700])
    display = Show(distortion, view)
    ColorBy(display, ("POINTS", "GeometricDifference"))
    display.RescaleTransferFunctionToDataRange(True)
    display.SetScalarBarVisibility(view, True)
    view.ResetCamera(True)
    SaveScreenshot(str(folder / "distortion.png"), view, ImageResolution=(900, 700))


def result(watermark, name):
    figures = watermark.GetDataInformation(1).GetFieldDataInformation()
    return figures.GetArrayInformation(name).GetComponentRange(0)[0]


def check_a_filter_runs_again_after_an_abort(model):
    """ParaView's VTK leaves it to the caller to reset AbortExecute."""
    attack = MeshAttack(Input=model, Attack="Simplification")
    filter = attack.SMProxy.GetClientSideObject()
    tag = filter.AddObserver("ProgressEvent", lambda caller, _: caller.SetAbortExecute(1))
    attack.UpdatePipeline()
    assert attack.GetDataInformation().GetNumberOfPoints() == 0
    filter.RemoveObserver(tag)
    attack.SimplificationPercent = 40.0
    attack.UpdatePipeline()
    assert attack.GetDataInformation().GetNumberOfPoints() > 0
    Delete(attack)


def check_nothing_shows_the_secret():
    """In the information panel, the spreadsheet and the statistics: all that a client knows of the outputs."""
    seen = ""
    for (name, _), source in GetSources().items():
        for port in range(source.SMProxy.GetNumberOfOutputPorts()):
            data = servermanager.Fetch(OutputPort(source, port))
            seen += f"{name} {source.GetDataInformation(port).DataInformation} {data} {texts_of(data)}"
    assert "Detected" in seen and SECRET not in seen


def texts_of(data):
    arrays = data.GetFieldData()
    return [arrays.GetAbstractArray(i).GetVariantValue(k).ToString()
            for i in range(arrays.GetNumberOfArrays())
            for k in range(arrays.GetAbstractArray(i).GetNumberOfValues())]


def check_a_trace_has_the_files_name_only(model, key_file):
    smtrace.start_trace()
    EmbedSpectralWatermark(Input=model, SecretKeyFile=key_file).UpdatePipeline()
    trace = smtrace.stop_trace()
    assert key_file in trace and SECRET not in trace, trace


def check_nothing_holds_the_secret(key_file, folder):
    state = folder / "state.pvsm"
    SaveState(str(state))
    script = folder / "state.py"
    script.write_text(smstate.get_state())
    for file in (state, script):
        text = file.read_text()
        assert SECRET not in text, file
        assert os.path.basename(key_file) in text, file


def check_macro(model, key_file):
    os.environ["SPECTRAL_WATERMARK_KEY_FILE"] = key_file
    SetActiveSource(model)
    macro = {**globals()}
    exec((Path(__file__).parent / "protect_and_verify.py").read_text(), macro)
    assert macro["verdict_of"](FindSource("Whose is it")).startswith("mine, p-value"), "macro"
    assert len(GetViewsInLayout(GetLayoutByName("Protect and verify"))) == 3


main(*sys.argv[1:])
