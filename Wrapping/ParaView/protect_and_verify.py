# SPDX-License-Identifier: BSD-3-Clause
"""A macro for ParaView: protects the selected mesh, attacks the result, and asks whose it is.

Macros > Import new macro..., then select a mesh in the pipeline browser and press "protect_and_verify".
Without a selection it takes a torus that it bends out of symmetry. The secret lies in KEY_FILE: a new
random one is made there the first time. Keep it: whoever has it can prove whose the mesh is.
"""

import os
import secrets

from paraview.simple import *

KEY_FILE = os.environ.get("SPECTRAL_WATERMARK_KEY_FILE",
                          os.path.expanduser("~/spectral-watermark.key"))


def main():
    key_file = make_key()
    original = selected_mesh()
    embed = EmbedSpectralWatermark(registrationName="Protected", Input=original,
                                   SecretKeyFile=key_file)
    attack = MeshAttack(registrationName="Noised copy", Input=OutputPort(embed, 0),
                        Attack="Noise, uniform")
    detect = DetectSpectralWatermark(registrationName="Whose is it", Input=attack,
                                     SecretKeyFile=key_file)
    distortion = MeshDistortion(registrationName="Distortion", Reference=original,
                                Distorted=OutputPort(embed, 0))
    for filter_ in (embed, detect, distortion):
        filter_.UpdatePipeline()
    show(original, attack, distortion, verdict_of(detect))
    print(verdict_of(detect))


def make_key():
    if not os.path.exists(KEY_FILE):
        with open(os.open(KEY_FILE, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
            file.write(secrets.token_urlsafe(32) + "\n")
        print(f"A new secret was made in {KEY_FILE}: keep it")
    return KEY_FILE


def selected_mesh():
    source = GetActiveSource()
    if source is not None:
        return source
    torus = Superquadric(registrationName="A model", ThetaResolution=192, PhiResolution=192)
    bend = Calculator(registrationName="Out of symmetry", Input=torus, ResultArrayName="bent",
                      CoordinateResults=1,
                      Function="iHat*(coordsX*(1+0.3*coordsY)) + jHat*1.3*coordsY + "
                               "kHat*(coordsZ+0.2*coordsX*coordsY+0.1*coordsX)")
    return bend


def verdict_of(detect):
    figures = detect.GetDataInformation(1).GetFieldDataInformation()
    detected, p_value = (figures.GetArrayInformation(name).GetComponentRange(0)[0]
                         for name in ("Detected", "PValue"))
    return f"{'mine' if detected else 'not mine'}, p-value {p_value:.2g}"


def show(original, attack, distortion, verdict):
    """Three views beside each other: the original, a noised copy with its verdict, what differs."""
    layout = CreateLayout("Protect and verify")
    views = [CreateRenderView() for _ in range(3)]
    AssignViewToLayout(views[0], layout)
    left = layout.SplitHorizontal(0, 1.0 / 3.0)
    layout.AssignView(left + 1, views[1])
    middle = layout.SplitHorizontal(left + 1, 0.5)
    layout.AssignView(middle + 1, views[2])
    # Two lines each: a third of a window is narrow.
    for view, source, caption in ((views[0], original, "the original\n"),
                                  (views[1], attack, f"a noised copy:\n{verdict}"),
                                  (views[2], distortion, "how far the\nprotected mesh moved")):
        display = Show(source, view)
        text = Show(Text(registrationName=" ".join(caption.split()), Text=caption), view)
        text.WindowLocation = "Upper Center"
        text.FontSize = 16
        if source is distortion:
            ColorBy(display, ("POINTS", "SurfaceDistance"))
            display.RescaleTransferFunctionToDataRange(True)
            display.SetScalarBarVisibility(view, True)
        else:
            display.ColorArrayName = ["POINTS", ""]
    for view in views:  # only now do they have their sizes
        Render(view)
        view.ResetCamera(True)
        Render(view)


main()
