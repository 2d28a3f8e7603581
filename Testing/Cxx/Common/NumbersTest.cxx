// SPDX-License-Identifier: BSD-3-Clause
// Proves which texts and which bytes are numbers, for all readers alike.
#include "Common/Numbers.h"
#include "Common/Bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

using namespace brainshift;

TEST(Numbers, HaveASignOrNone)
{
  EXPECT_EQ(numberIn("12.5"), 12.5);
  EXPECT_EQ(numberIn("-12.5e1"), -125.0);
  EXPECT_EQ(numberIn("+.5"), 0.5);
  EXPECT_EQ(numberIn<int>("+7"), 7);
  for (const char* text : { "", "+", "-", "+-5", "-+5", "++5", "--5", "5+" })
  {
    EXPECT_EQ(numberIn(text), std::nullopt) << text;
  }
}

TEST(Numbers, AreTheWholeText)
{
  for (const char* text : { "1 ", " 1", "1,5", "1.5mm", "0x10", "1.2.3", "one" })
  {
    EXPECT_EQ(numberIn(text), std::nullopt) << text;
  }
  EXPECT_EQ(numberIn<int>("1.5"), std::nullopt);
  EXPECT_EQ(numberIn(std::string_view("2\0", 2)), std::nullopt);
}

TEST(Numbers, MustFitTheirType)
{
  EXPECT_EQ(numberIn("1e999"), std::nullopt);
  EXPECT_EQ(numberIn<unsigned char>("255"), 255);
  EXPECT_EQ(numberIn<unsigned char>("256"), std::nullopt);
  EXPECT_EQ(numberIn<unsigned char>("-1"), std::nullopt);
  EXPECT_EQ(numberIn<signed char>("-128"), -128);
  EXPECT_EQ(numberIn<std::int32_t>("2147483648"), std::nullopt);
  EXPECT_EQ(numberIn<long long>("9007199254740993"), 9007199254740993LL);
}

TEST(Numbers, MayBeInfiniteOrNaN)
{
  EXPECT_EQ(numberIn("inf"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(numberIn("-INF"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(numberIn("nan").value_or(0.0)));
  EXPECT_EQ(numberIn<int>("inf"), std::nullopt);
}

TEST(Numbers, AreTakenOffTheBeginning)
{
  std::string_view text = "+3.5-7rest";
  EXPECT_EQ(takeNumber<double>(text), 3.5);
  EXPECT_EQ(takeNumber<int>(text), -7);
  EXPECT_EQ(takeNumber<int>(text), std::nullopt);
  EXPECT_EQ(text, "rest");
}

TEST(Numbers, OfAListEndAtWhatIsNone)
{
  EXPECT_EQ(numbersIn(" 1\t-2\r\n+3e2 "), (std::vector<double>{ 1.0, -2.0, 300.0 }));
  EXPECT_TRUE(numbersIn(" \n").empty());
  for (const char* text : { "1 2x 3", "1 2,3", "1 - 3" })
  {
    const std::vector<double> found = numbersIn(text);
    ASSERT_EQ(found.size(), 2u) << text;
    EXPECT_EQ(found[0], 1.0);
    EXPECT_TRUE(std::isnan(found[1])) << text;
  }
  std::vector<double> numbers{ 4.0 };
  EXPECT_TRUE(appendNumbers("5 nan", numbers));
  EXPECT_EQ(numbers.size(), 3u);
  EXPECT_FALSE(appendNumbers("6 end", numbers));
  EXPECT_EQ(numbers.back(), 6.0);
}

TEST(Numbers, AreWholeBetweenLimits)
{
  EXPECT_TRUE(isWhole(3.0, 3.0, 4.0));
  EXPECT_FALSE(isWhole(3.5, 3.0, 4.0));
  EXPECT_FALSE(isWhole(5.0, 3.0, 4.0));
  EXPECT_FALSE(isWhole(std::nan(""), 3.0, 4.0));
  EXPECT_FALSE(isWhole(std::numeric_limits<double>::infinity(), 3.0, 4.0));
}

TEST(Numbers, ReadBackAsTheyWereWritten)
{
  for (const double number : { 0.1, -1.0 / 3.0, 1e300, 5e-324 })
  {
    EXPECT_EQ(numberIn(numberText(number)), number);
  }
  EXPECT_EQ(numberText(0.5), "0.5");
}

TEST(Bytes, AreNumbersInEitherOrder)
{
  const std::string_view bytes("\x01\x02\x03\xfe\x3f\x80\x00\x00", 8);
  EXPECT_EQ(storedNumber<std::uint16_t>(bytes.data(), true), 0x0102);
  EXPECT_EQ(storedNumber<std::uint16_t>(bytes.data(), false), 0x0201);
  EXPECT_EQ(storedNumber<std::int32_t>(bytes.data(), true), 0x010203fe);
  EXPECT_EQ(storedNumber<std::int32_t>(bytes.data(), false), -0x1fcfdff);
  EXPECT_EQ(storedNumber<float>(bytes.data() + 4, true), 1.0f);
}

TEST(Bytes, HoldNoNumberBehindTheirEnd)
{
  const std::string_view bytes("\x00\x00\x00\x07\x09", 5);
  EXPECT_EQ(storedNumberAt<std::uint32_t>(bytes, 0, true), 7u);
  EXPECT_EQ(storedNumberAt<std::uint32_t>(bytes, 1, true), 0x709u);
  EXPECT_EQ(storedNumberAt<std::uint32_t>(bytes, 2, true), std::nullopt);
  EXPECT_EQ(storedNumberAt<std::uint8_t>(bytes, 5, true), std::nullopt);
  EXPECT_EQ(storedNumberAt<std::uint32_t>(bytes, std::size_t(-2), true), std::nullopt);
}

TEST(Bytes, OfManyNumbersComeToTheOrderOfThisMachine)
{
  for (const bool isBigEndian : { true, false })
  {
    std::string bytes("\x01\x02\x03\x04", 4);
    toMachineOrder(bytes.data(), 2, 2, isBigEndian);
    EXPECT_EQ(storedNumber<std::uint16_t>(bytes.data(), thisMachineIsBigEndian()),
      isBigEndian ? 0x0102 : 0x0201);
    EXPECT_EQ(storedNumber<std::uint16_t>(bytes.data() + 2, thisMachineIsBigEndian()),
      isBigEndian ? 0x0304 : 0x0403);
  }
}

TEST(Numbers, MeasuredOnesHaveThreeDigits)
{
  EXPECT_EQ(roundedText(14.2222), "14.2");
  EXPECT_EQ(roundedText(0.05f), "0.05");
  EXPECT_EQ(roundedText(8.0), "8");
  EXPECT_EQ(roundedText(-0.012345), "-0.0123");
  EXPECT_EQ(roundedText(999.6), "1000");
  EXPECT_EQ(roundedText(123456.7), "123457");
  EXPECT_EQ(roundedText(INFINITY), "inf");
}

TEST(Numbers, FractionsAreWholePercent)
{
  EXPECT_EQ(percentText(0.584615), "58 %");
  EXPECT_EQ(percentText(0.999), "99 %") << "not all of it";
  EXPECT_EQ(percentText(0.001), "less than 1 %");
  EXPECT_EQ(percentText(1.0), "100 %");
}
