// SPDX-License-Identifier: BSD-3-Clause
// Proves that grids, strips and depth shafts are recognised by labels or by positions, that missing
// contacts are named, and that what is doubtful is said. The sheets are bent, with noise of 0.3 mm.
#include "Filters/Electrodes/ContactArrays.h"
#include "Common/Problem.h"
#include "Testing/Cxx/Electrodes/SyntheticGrids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double NoiseMm = 0.3;

std::string numbered(const std::string& prefix, int number)
{
  return prefix + std::to_string(number);
}

// A bent grid whose labels run along its rows.
std::vector<Contact> gridOfShape(const GridShape& shape, const std::string& prefix, unsigned seed)
{
  const Sag sag = sagAt({ 1.0, 0.1, 0.6 }, 8.0, 10.0, seed);
  const LaidGrid grid = laidGrid(shape, sag, 0.3 * seed, { 4.0, -3.0 }, NoiseMm, seed);
  std::vector<Contact> contacts;
  contacts.reserve(grid.sheet.contacts.size());
  for (const std::optional<glm::dvec3>& position : grid.sheet.contacts)
  {
    const int number = static_cast<int>(contacts.size()) + 1;
    contacts.push_back({ position.value_or(glm::dvec3(0.0)), numbered(prefix, number), "" });
  }
  return contacts;
}

std::vector<Contact> shaft(const std::string& prefix, int count, double pitchMm)
{
  std::vector<Contact> contacts;
  contacts.reserve(count);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.2);
  const glm::dvec3 along = glm::normalize(glm::dvec3(-1.0, 0.2, 0.1));
  for (int i = 0; i < count; ++i)
  {
    contacts.push_back({ glm::dvec3(60.0, 5.0, 5.0) + pitchMm * i * along +
        glm::dvec3(noise(random), noise(random), noise(random)),
      numbered(prefix, i + 1), "" });
  }
  return contacts;
}

std::vector<std::string> labelsOf(const std::vector<Contact>& contacts)
{
  std::vector<std::string> labels;
  labels.reserve(contacts.size());
  for (const Contact& contact : contacts)
  {
    labels.push_back(contact.label);
  }
  return labels;
}

bool says(const ContactArray& array, const std::string& words)
{
  return std::any_of(array.doubts.begin(), array.doubts.end(),
    [&](const std::string& doubt) { return doubt.find(words) != std::string::npos; });
}
}

class ContactArraysOf : public ::testing::TestWithParam<GridShape>
{
};

TEST_P(ContactArraysOf, FindsShapePitchAndOrderInAnyOrderOfTheList)
{
  const GridShape shape = GetParam();
  std::vector<Contact> contacts = gridOfShape(shape, "LTG", 3);
  std::mt19937 random(1);
  std::shuffle(contacts.begin(), contacts.end(), random);
  const std::vector<ContactArray> arrays = recogniseArrays(contacts);
  ASSERT_EQ(arrays.size(), 1u);
  const ContactArray& array = arrays.front();
  EXPECT_EQ(array.name, "LTG");
  EXPECT_EQ(array.kind, ArrayKind::Grid);
  EXPECT_TRUE(array.byLabels);
  EXPECT_EQ(array.rows, shape.rows);
  EXPECT_EQ(array.columns, shape.columns);
  EXPECT_NEAR(array.pitchMm, shape.pitchMm, 0.02 * shape.pitchMm);
  EXPECT_TRUE(array.doubts.empty()) << array.doubts.front();
  for (std::size_t k = 0; k < array.contacts.size(); ++k)
  {
    ASSERT_TRUE(array.contacts[k]);
    const std::size_t contact = array.contacts[k].value_or(0);
    EXPECT_EQ(contacts[contact].label, numbered("LTG", static_cast<int>(k) + 1));
  }
}

TEST_P(ContactArraysOf, NamesMissingContacts)
{
  const GridShape shape = GetParam();
  std::vector<Contact> contacts = gridOfShape(shape, "G", 4);
  const std::vector<int> gone{ 1, 8, 9, shape.rows * shape.columns };
  for (auto number = gone.rbegin(); number != gone.rend(); ++number)
  {
    contacts.erase(contacts.begin() + *number - 1);
  }
  const ContactArray array = recogniseArrays(contacts).front();
  ASSERT_EQ(array.rows * array.columns, shape.rows * shape.columns);
  EXPECT_EQ(array.columns, shape.columns);
  for (const int number : gone)
  {
    EXPECT_FALSE(array.contacts[number - 1]);
    EXPECT_EQ(array.labels[number - 1], numbered("G", number));
  }
}

TEST_P(ContactArraysOf, FindsTheOrderInPositionsIfLabelsAreShuffled)
{
  const GridShape shape = GetParam();
  std::vector<Contact> contacts = gridOfShape(shape, "G", 5);
  std::vector<std::string> labels = labelsOf(contacts);
  std::mt19937 random(2);
  std::shuffle(labels.begin(), labels.end(), random);
  for (std::size_t i = 0; i < contacts.size(); ++i)
  {
    contacts[i].label = labels[i];
  }
  const ContactArray array = recogniseArrays(contacts).front();
  EXPECT_FALSE(array.byLabels);
  EXPECT_TRUE(says(array, "labels that do not follow"));
  EXPECT_EQ(std::minmax(array.rows, array.columns), std::minmax(shape.rows, shape.columns));
  EXPECT_NEAR(array.pitchMm, shape.pitchMm, 0.02 * shape.pitchMm);
  // Neighbours of the list are neighbours of the sheet.
  std::vector<int> places(contacts.size(), -1);
  for (std::size_t k = 0; k < array.contacts.size(); ++k)
  {
    ASSERT_TRUE(array.contacts[k]);
    places[array.contacts[k].value_or(0)] = static_cast<int>(k);
  }
  for (int i = 0; i + 1 < shape.columns; ++i)
  {
    const int a = places[i];
    const int b = places[i + 1];
    EXPECT_EQ(std::abs(a / array.columns - b / array.columns) +
        std::abs(a % array.columns - b % array.columns),
      1);
  }
}

TEST_P(ContactArraysOf, FindsGridsWithoutLabels)
{
  const GridShape shape = GetParam();
  std::vector<Contact> contacts = gridOfShape(shape, "", 6);
  for (Contact& contact : contacts)
  {
    contact.label.clear();
  }
  contacts.erase(contacts.begin() + shape.columns + 1);
  const std::vector<ContactArray> arrays = recogniseArrays(contacts);
  ASSERT_EQ(arrays.size(), 1u);
  EXPECT_EQ(arrays.front().kind, ArrayKind::Grid);
  EXPECT_EQ(std::minmax(arrays.front().rows, arrays.front().columns),
    std::minmax(shape.rows, shape.columns));
}

INSTANTIATE_TEST_SUITE_P(Shapes, ContactArraysOf,
  ::testing::Values(GridShape{ 8, 8, 10.0 }, GridShape{ 4, 8, 10.0 }, GridShape{ 6, 6, 5.0 },
    GridShape{ 4, 5, 10.0 }, GridShape{ 8, 4, 10.0 }, GridShape{ 2, 8, 10.0 },
    GridShape{ 8, 16, 5.0 }));

TEST(ContactArrays, KnowStripsAndShaftsBesideAGrid)
{
  std::vector<Contact> contacts = gridOfShape({ 4, 8, 10.0 }, "G", 7);
  const std::vector<Contact> strip = gridOfShape({ 1, 6, 10.0 }, "ST", 8);
  const std::vector<Contact> depth = shaft("HIP", 10, 3.5);
  contacts.insert(contacts.end(), strip.begin(), strip.end());
  contacts.insert(contacts.end(), depth.begin(), depth.end());
  const std::vector<ContactArray> arrays = recogniseArrays(contacts);
  ASSERT_EQ(arrays.size(), 3u);
  EXPECT_EQ(arrays[0].kind, ArrayKind::Grid);
  EXPECT_EQ(arrays[1].kind, ArrayKind::Strip);
  EXPECT_EQ(arrays[1].columns, 6);
  EXPECT_EQ(arrays[2].kind, ArrayKind::Depth);
  EXPECT_EQ(arrays[2].columns, 10);
  EXPECT_NEAR(arrays[2].pitchMm, 3.5, 0.1);
}

TEST(ContactArrays, TellShaftsByTheirDepth)
{
  const auto depth = [](const glm::dvec3& position) {
    const SurfacePoint foot = WavyCortex::nearest(position);
    return glm::dot(foot.normal, foot.position - position);
  };
  const std::vector<ContactArray> wide = recogniseArrays(shaft("D", 6, 10.0), {}, depth);
  EXPECT_EQ(wide.front().kind, ArrayKind::Depth);
  const std::vector<ContactArray> strip =
    recogniseArrays(gridOfShape({ 1, 4, 5.0 }, "S", 9), {}, depth);
  EXPECT_EQ(strip.front().kind, ArrayKind::Strip);
}

TEST(ContactArrays, FollowNumbersThatTurnBackInEachRow)
{
  std::vector<Contact> contacts = gridOfShape({ 4, 6, 10.0 }, "G", 10);
  for (int row = 1; row < 4; row += 2)
  {
    for (int column = 0; column < 3; ++column)
    {
      std::swap(contacts[6 * row + column].label, contacts[6 * row + 5 - column].label);
    }
  }
  const ContactArray array = recogniseArrays(contacts).front();
  EXPECT_EQ(array.kind, ArrayKind::Grid);
  EXPECT_EQ(std::minmax(array.rows, array.columns), std::minmax(4, 6));
  EXPECT_TRUE(array.byLabels);
}

TEST(ContactArrays, SayDoubtsByName)
{
  std::vector<Contact> contacts = gridOfShape({ 8, 8, 10.0 }, "G", 11);
  std::swap(contacts[27].label, contacts[44].label); // G28 and G45
  contacts.push_back({ contacts[3].position + glm::dvec3(4.0, 0.0, 0.0), "G4", "" });
  const ContactArray array = recogniseArrays(contacts).front();
  EXPECT_EQ(array.kind, ArrayKind::Grid);
  EXPECT_EQ(array.rows, 8);
  EXPECT_TRUE(says(array, "the label G4 twice"));
  EXPECT_TRUE(says(array, "G28"));
  EXPECT_TRUE(says(array, "G45"));
}

TEST(ContactArrays, SayWhatHasNoOrder)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-40.0, 40.0);
  std::vector<Contact> contacts;
  for (int i = 1; i <= 20; ++i)
  {
    contacts.push_back(
      { { anywhere(random), anywhere(random), anywhere(random) }, numbered("X", i), "" });
  }
  const ContactArray array = recogniseArrays(contacts).front();
  EXPECT_EQ(array.kind, ArrayKind::Unknown);
  EXPECT_TRUE(says(array, "no order"));
  EXPECT_TRUE(says(recogniseArrays({ { {}, "A1", "" } }).front(), "too few"));
}

TEST(ContactArrays, ReadHints)
{
  const ArrayHint hint = hintIn("LTG=grid 4x8 10mm");
  EXPECT_EQ(hint.group, "LTG");
  EXPECT_EQ(hint.kind, ArrayKind::Grid);
  EXPECT_EQ(hint.rows, 4);
  EXPECT_EQ(hint.columns, 8);
  EXPECT_EQ(hint.pitchMm, 10.0);
  EXPECT_EQ(hintIn("A=depth").kind, ArrayKind::Depth);
  for (const char* wrong : { "LTG", "LTG=8", "LTG=0x8", "LTG=8x8x8", "LTG=round", "LTG=-1mm" })
  {
    EXPECT_THROW(hintIn(wrong), Problem) << wrong;
  }
}

TEST(ContactArrays, TakeHintsFirst)
{
  std::vector<Contact> contacts = gridOfShape({ 4, 8, 10.0 }, "G", 12);
  contacts.resize(24); // the last row is missing, which only the hint can know
  const ContactArray array = recogniseArrays(contacts, { hintIn("G=8x4 10mm") }).front();
  EXPECT_EQ(array.rows, 4);
  EXPECT_EQ(array.columns, 8);
  EXPECT_EQ(array.labels.back(), "G32");
}

// The labels start elsewhere than at 1: a contact's number is its place and what is before that.
TEST(ContactArrays, FollowNumbersThatStartLater)
{
  for (const auto& [rows, columns, first] :
    { std::tuple(7, 8, 9), std::tuple(6, 8, 17), std::tuple(4, 8, 5), std::tuple(4, 8, 65) })
  {
    std::vector<Contact> contacts = gridOfShape({ rows, columns, 10.0 }, "G", 13);
    for (int k = 0; k < rows * columns; ++k)
    {
      contacts[k].label = numbered("G", first + k);
    }
    const std::string shape = "G=" + std::to_string(rows) + "x" + std::to_string(columns);
    for (const bool isGiven : { true, false })
    {
      SCOPED_TRACE(shape + (isGiven ? " given, " : " found, ") + std::to_string(first));
      const std::vector<ArrayHint> hints =
        isGiven ? std::vector<ArrayHint>{ hintIn(shape) } : std::vector<ArrayHint>();
      const ContactArray array = recogniseArrays(contacts, hints).front();
      EXPECT_TRUE(array.byLabels);
      EXPECT_EQ(array.rows, rows);
      EXPECT_EQ(array.columns, columns);
      EXPECT_EQ(array.labels, labelsOf(contacts));
      EXPECT_EQ(std::count(array.contacts.begin(), array.contacts.end(), std::nullopt), 0);
      // Rows before these may be missing.
      EXPECT_EQ(says(array, "starts at"), !isGiven && (first == 9 || first == 17));
      EXPECT_EQ(array.doubts.size(), says(array, "starts at") ? 1u : 0u);
    }
  }
}

TEST(ContactArrays, DoubtAShapeThatIsWrong)
{
  const std::vector<Contact> contacts = gridOfShape({ 8, 8, 10.0 }, "G", 14);
  const ContactArray array = recogniseArrays(contacts, { hintIn("G=8x7") }).front();
  EXPECT_EQ(std::minmax(array.rows, array.columns), std::minmax(7, 8));
  EXPECT_TRUE(says(array, "outside of its shape: G57, G58"));
}

TEST(ContactArrays, DoubtARowThatHasNoContacts)
{
  std::vector<Contact> contacts = gridOfShape({ 8, 8, 10.0 }, "G", 15);
  contacts.erase(contacts.begin(), contacts.begin() + 8);
  const ContactArray array = recogniseArrays(contacts, { hintIn("G=8x8") }).front();
  EXPECT_EQ(array.rows, 8);
  EXPECT_EQ(array.labels.front(), "G1");
  EXPECT_FALSE(array.contacts.front());
  EXPECT_TRUE(says(array, "no contact in its first row"));
}

TEST(ContactArrays, DoubtRowsAndColumnsThatAreNotAsFarApart)
{
  std::mt19937 random(16);
  std::normal_distribution<double> noise(0.0, NoiseMm);
  std::vector<Contact> contacts;
  contacts.reserve(32);
  for (int k = 0; k < 32; ++k)
  {
    const int row = k / 8;
    const int column = k % 8;
    const glm::dvec3 position(
      10.0 * column + noise(random), 8.0 * row + noise(random), 0.3 * column * column);
    contacts.push_back({ position, numbered("G", k + 1), "" });
  }
  const ContactArray array = recogniseArrays(contacts).front();
  EXPECT_EQ(array.columns, 8);
  EXPECT_TRUE(says(array, "mm apart along its rows"));
  // A sheet that is stretched by a sag under it is none of these.
  for (const unsigned seed : { 1u, 2u, 3u, 4u })
  {
    const ContactArray sagged =
      recogniseArrays(gridOfShape({ 8, 8, 10.0, true }, "G", seed)).front();
    EXPECT_FALSE(says(sagged, "mm apart along its rows")) << seed;
  }
}

TEST(ContactArrays, NamePlacesWithoutLabels)
{
  std::vector<Contact> contacts = gridOfShape({ 4, 8, 10.0 }, "", 17);
  for (Contact& contact : contacts)
  {
    contact.label.clear();
  }
  std::vector<Contact> aside = contacts;
  for (Contact& contact : aside)
  {
    contact.position += glm::dvec3(0.0, 200.0, 0.0);
  }
  contacts.erase(contacts.begin() + 18);
  contacts.erase(contacts.begin() + 9);
  const std::vector<std::string> alone = recogniseArrays(contacts).front().labels;
  EXPECT_EQ(std::count(alone.begin(), alone.end(), ""), 30);
  const auto named = std::find_if(
    alone.begin(), alone.end(), [](const std::string& label) { return !label.empty(); });
  ASSERT_NE(named, alone.end());
  EXPECT_EQ(*named,
    "r" + std::to_string((named - alone.begin()) / 8 + 1) + "c" +
      std::to_string((named - alone.begin()) % 8 + 1));
  contacts.insert(contacts.end(), aside.begin() + 1, aside.end() - 1);
  const std::vector<ContactArray> both = recogniseArrays(contacts);
  ASSERT_EQ(both.size(), 2u);
  for (const ContactArray& array : both)
  {
    const std::string number = &array == both.data() ? "1-r" : "2-r";
    const auto missing = std::count_if(array.labels.begin(), array.labels.end(),
      [&](const std::string& label) { return label.compare(0, 3, number) == 0; });
    EXPECT_EQ(missing, 2);
  }
}
