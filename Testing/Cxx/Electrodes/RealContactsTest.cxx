// SPDX-License-Identifier: BSD-3-Clause
// Proves that the electrodes of 51 patients get the shape that steps between their labels show, and
// that those whose labels and positions contradict each other are named.
#include "Filters/Electrodes/ContactArrays.h"
#include "Filters/Electrodes/ContactOrder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <tuple>

using namespace brainshift;

namespace
{
// The contacts of each patient.
std::map<std::string, std::vector<Contact>> patients()
{
  std::map<std::string, std::vector<Contact>> found;
  std::ifstream file(std::string(BRAINSHIFT_TEST_DATA) + "/openneuro-ds003688/contacts.tsv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line))
  {
    std::istringstream fields(line);
    std::string patient;
    Contact contact;
    fields >> patient >> contact.label >> contact.position.x >> contact.position.y >>
      contact.position.z;
    found[patient].push_back(contact);
  }
  return found;
}

int numberOf(const std::string& label)
{
  return std::stoi(label.substr(label.find_last_not_of("0123456789") + 1));
}

// Another road to a shape: where the labels go on to the next row, the step is that to the other
// end of the grid. 0 columns: the steps are too uneven to say.
glm::ivec2 shapeBySteps(const std::vector<Contact>& contacts, const ContactArray& array)
{
  std::map<int, glm::dvec3> byNumber;
  for (const std::size_t member : array.members)
  {
    byNumber[numberOf(contacts[member].label)] = contacts[member].position;
  }
  const int count = static_cast<int>(array.members.size());
  if (count < 4 || byNumber.rbegin()->first - byNumber.begin()->first + 1 != count)
  {
    return { 0, 0 };
  }
  std::vector<double> steps;
  for (auto next = std::next(byNumber.begin()); next != byNumber.end(); ++next)
  {
    steps.push_back(glm::distance(std::prev(next)->second, next->second));
  }
  const double pitch = median(steps);
  int columns = count;
  for (int i = 0; i < count - 1; ++i)
  {
    const bool isEnd = steps[i] > 2.0 * pitch;
    columns = isEnd && columns == count ? i + 1 : columns;
    const bool isNext = (i + 1) % columns == 0;
    const double expected = isNext ? pitch * std::hypot(columns - 1, 1) : pitch;
    const double uneven = isNext ? 0.2 : 0.4; // of a step to the other end less, for it is long
    if (std::abs(steps[i] - expected) > uneven * expected)
    {
      return { 0, 0 };
    }
  }
  return count % columns == 0 ? glm::ivec2(count / columns, columns) : glm::ivec2(0, 0);
}

ContactArray arrayOf(const std::string& patient, const std::string& name)
{
  for (ContactArray& array : recogniseArrays(patients()[patient]))
  {
    if (array.name == name)
    {
      return array;
    }
  }
  return {};
}
}

TEST(RealContacts, GetTheShapeOfTheirLabels)
{
  int electrodes = 0;
  int clear = 0;
  int byLabels = 0;
  for (const auto& [patient, contacts] : patients())
  {
    for (const ContactArray& array : recogniseArrays(contacts))
    {
      ++electrodes;
      byLabels += array.byLabels && array.rows > 0 ? 1 : 0;
      const glm::ivec2 shape = shapeBySteps(contacts, array);
      if (shape.y > 0)
      {
        ++clear;
        EXPECT_EQ(glm::ivec2(array.rows, array.columns), shape) << patient << " " << array.name;
        EXPECT_TRUE(array.byLabels) << patient << " " << array.name;
      }
    }
  }
  RecordProperty("electrodes", electrodes);
  std::printf("%d electrodes: %d by labels, %d with clear steps\n", electrodes, byLabels, clear);
  EXPECT_EQ(electrodes, 280);
  EXPECT_GE(byLabels, 273);
  EXPECT_GE(clear, 200);
}

TEST(RealContacts, ThatAreExchangedKeepTheShapeAndAreNamed)
{
  for (const auto& [patient, name, rows] :
    { std::tuple("sub-12", "F", 8), { "sub-34", "T", 8 }, { "sub-46", "T", 6 } })
  {
    const ContactArray array = arrayOf(patient, name);
    EXPECT_EQ(glm::ivec2(array.rows, array.columns), glm::ivec2(rows, 8)) << patient;
    ASSERT_FALSE(array.doubts.empty()) << patient;
    EXPECT_NE(array.doubts.front().find("not between their neighbours"), std::string::npos)
      << array.doubts.front();
  }
}

TEST(RealContacts, OfAStripThatBendsAreNoGrid)
{
  for (const auto& [patient, name] : { std::pair("sub-05", "vT"), { "sub-34", "sTa" } })
  {
    const ContactArray array = arrayOf(patient, name);
    EXPECT_EQ(array.kind, ArrayKind::Strip) << patient;
    EXPECT_EQ(array.columns, 8) << patient;
    EXPECT_FALSE(array.doubts.empty()) << patient;
  }
}
