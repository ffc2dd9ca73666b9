# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView shows of the filters is what the filters have: every property, with its default."""

import unittest
import xml.etree.ElementTree as ET
from pathlib import Path

import spectralwatermark
from spectralwatermark.attacks import ATTACKS, PROPERTIES_OF_EVERY_ATTACK

XML = Path(__file__).resolve().parents[2] / "Wrapping" / "ParaView" / "SpectralWatermark" / "SpectralWatermark.xml"
FILTERS = ("vtkManifoldHarmonics", "vtkManifoldHarmonicsReconstruction", "vtkManifoldHarmonicsSimilarity",
           "vtkMeshAttack", "vtkMeshDistortion", "vtkSpectralWatermarkDetect", "vtkSpectralWatermarkEmbed")
# What ParaView has otherwise than the classes, on purpose.
DIFFERENT = {
    "UseDerivedMessage",  # on: a key file is what one has there
    "NumberOfBits",  # 0 stands for the scheme's own, which is what the getter tells
}
HIDDEN = {"SecretKey"}  # no state or trace may hold it
OF_VTK = {"ReferenceCount"}


def setters_of(cls):
    """The properties that can be set, of the class and of ours that it derives from."""
    names = set()
    for each in cls.__mro__:
        if each.__module__.startswith("spectralwatermark"):
            names |= {name[3:] for name in vars(each)
                      if name.startswith("Set") and "To" not in name.replace("Tolerance", "")}
    return names


class ParaViewXmlTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.proxies = {proxy.get("class"): proxy for proxy in ET.parse(XML).iter("SourceProxy")}

    def test_every_filter_is_there(self):
        self.assertEqual(sorted(self.proxies), sorted(FILTERS))

    def test_every_property_is_there_but_the_secret(self):
        for name in FILTERS:
            shown = {each.get("command", "").removeprefix("Set") for each in self.proxies[name]
                     if each.get("command", "").startswith("Set")}
            own = setters_of(getattr(spectralwatermark, name))
            self.assertGreaterEqual(len(own), 2, name)
            self.assertEqual(own - HIDDEN - OF_VTK - shown, set(), name)
            self.assertEqual(shown & HIDDEN, set(), name)

    def test_defaults_are_the_classes(self):
        compared = 0
        for name in FILTERS:
            fresh = getattr(spectralwatermark, name)()
            for each in self.proxies[name]:
                key = each.get("command", "").removeprefix("Set")
                if "default_values" not in each.attrib or key in DIFFERENT or key == "Gain":
                    continue
                value = getattr(fresh, f"Get{key}")()
                shown = each.get("default_values")
                if not isinstance(value, str):
                    shown = tuple(float(word) for word in shown.split())
                    value = tuple(map(float, value if isinstance(value, tuple) else (value,)))
                self.assertEqual(shown, value, f"{name}: {key}")
                compared += 1
        self.assertGreater(compared, 50)

    def test_ranges_are_the_classes(self):
        for name in FILTERS:
            fresh = getattr(spectralwatermark, name)()
            for each in self.proxies[name]:
                key = each.get("command", "").removeprefix("Set")
                domain = each.find("IntRangeDomain")
                domain = each.find("DoubleRangeDomain") if domain is None else domain
                if domain is None or key == "Gain":
                    continue
                for limit, getter in (("min", f"Get{key}MinValue"), ("max", f"Get{key}MaxValue")):
                    if limit in domain.attrib and hasattr(fresh, getter):
                        self.assertAlmostEqual(float(domain.get(limit)), getattr(fresh, getter)(), 12,
                                               f"{name}: {key}")

    def test_enumerations_name_every_value(self):
        for name in FILTERS:
            fresh = getattr(spectralwatermark, name)()
            for each in self.proxies[name].iter("IntVectorProperty"):
                entries = each.findall("EnumerationDomain/Entry")
                key = each.get("command", "").removeprefix("Set")
                if entries and key != "OutputPointsPrecision":
                    self.assertEqual([entry.get("value") for entry in entries],
                                     [str(i) for i in range(len(entries))])
                    for entry in entries:
                        getattr(fresh, f"Set{key}")(int(entry.get("value")))
                        said = getattr(fresh, f"Get{key}AsString")()
                        self.assertNotEqual(said, "Unknown", f"{name}: {key} {entry.get('text')}")
                    getattr(fresh, f"Set{key}")(len(entries))
                    beyond = getattr(fresh, f"Get{key}AsString")()
                    self.assertTrue(beyond == "Unknown" or getattr(fresh, f"Get{key}")() < len(entries),
                                    f"{name}: {key} has more values")


class AttackTableTest(unittest.TestCase):
    """The table of attacks and ParaView's XML show the same attacks, each with the same properties."""

    @classmethod
    def setUpClass(cls):
        proxy = next(proxy for proxy in ET.parse(XML).iter("SourceProxy") if proxy.get("class") == "vtkMeshAttack")
        cls.properties = {each.get("name"): each for each in proxy if each.tag.endswith("VectorProperty")}
        cls.kinds = {getattr(spectralwatermark.vtkMeshAttack, attack.kind) for attack in ATTACKS.values()}

    def properties_in_table(self, kind):
        return {name for attack in ATTACKS.values() if getattr(spectralwatermark.vtkMeshAttack, attack.kind) == kind
                for name in attack.properties()}

    def properties_in_xml(self, kind):
        """ParaView shows a property while the attack that it belongs to is chosen."""
        return {name for name, each in self.properties.items()
                if any(hint.get("property") == "Attack" and hint.get("value") == str(kind)
                       for hint in each.iter("PropertyWidgetDecorator"))}

    def test_same_attacks(self):
        shown = {int(entry.get("value")) for entry in self.properties["Attack"].iter("Entry")}
        self.assertEqual(shown, self.kinds)
        self.assertEqual(len(shown), 15)

    def test_same_properties_for_each_attack(self):
        for kind in self.kinds:
            self.assertEqual(self.properties_in_table(kind), self.properties_in_xml(kind), kind)

    def test_same_properties_in_all(self):
        in_table = {name for attack in ATTACKS.values() for name in attack.properties()}
        self.assertEqual(in_table | set(PROPERTIES_OF_EVERY_ATTACK), set(self.properties))

    def test_types_are_the_classes(self):
        fresh = spectralwatermark.vtkMeshAttack()
        for attack in ATTACKS.values():
            if not attack.property:
                continue
            value = getattr(fresh, f"Get{attack.property}")()
            if isinstance(value, tuple):
                self.assertEqual(len(value), len(attack.metavar), attack.name)
                value = value[0]
            self.assertIs(int if attack.choices else attack.type, type(value), attack.name)

    def test_choices_are_paraviews(self):
        for attack in ATTACKS.values():
            entries = [int(entry.get("value")) for entry in self.properties[attack.property].iter("Entry")
                       ] if attack.property else []
            self.assertEqual([getattr(spectralwatermark.vtkMeshAttack, name) for name in attack.choices.values()],
                             entries, attack.name)


if __name__ == "__main__":
    unittest.main()
