#include "base/text.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace elastolab {
namespace {

TEST(Text, IsPutOnOneLine) {
    EXPECT_EQ(one_line("a\nb\tc\x1b[0m"), "a b c [0m");
    EXPECT_EQ(one_line("\xc2\x9b[31m \x9b[31m \xff\xc3"), " [31m ?[31m ??");  // a control code of 8 bits; no characters
    const std::string words = "\xc3\xa9t\xc3\xa9 \xe2\x82\xac \xf0\x9f\x90\x87 \xc2\xa0";
    EXPECT_EQ(one_line(words), words);
}

TEST(Text, KeepsLettersButNoBytesThatTerminalsObey) {
    EXPECT_EQ(one_line("w\u00fcrfel \u20ac \U0001f600"), "w\u00fcrfel \u20ac \U0001f600");
    EXPECT_EQ(one_line("a\u009b2Jb\u0085c\u00a0"), "a 2Jb c\u00a0");
    EXPECT_EQ(one_line("a\x9b"
                       "2J\xff"),
              "a?2J?");
    EXPECT_EQ(one_line("cut \xe2\x82"), "cut ??");
    EXPECT_EQ(one_line("\xc3("), "?(");
}

TEST(Text, IsShortenedByWholeCharacters) {
    EXPECT_EQ(shortened("abcd", 4), "abcd");
    EXPECT_EQ(shortened("abcde", 4), "abcd...");
    EXPECT_EQ(shortened("ab\u20acd", 5), "ab\u20ac...");
    for (const std::size_t longest : {2u, 3u, 4u}) EXPECT_EQ(shortened("ab\u20acd", longest), "ab...");
    EXPECT_EQ(shortened("\x80\x80\x80\x80\x80\x80", 5).size(), 2 + 3u) << "no characters at all";
}

TEST(Text, BytesAreReadable) {
    EXPECT_EQ(readable_bytes(812), "812 bytes");
    EXPECT_EQ(readable_bytes(3.4e6), "3.40 MB");
    EXPECT_EQ(readable_bytes(14.14e9), "14.1 GB");
    EXPECT_EQ(readable_bytes(999.99e3), "1.00 MB");
}

TEST(Text, SecondsAreReadable) {
    EXPECT_EQ(readable_seconds(85e-6), "85 us");
    EXPECT_EQ(readable_seconds(12.3e-3), "12.3 ms");
    EXPECT_EQ(readable_seconds(4.52), "4.52 s");
    EXPECT_EQ(readable_seconds(444.0), "7.4 min");
}

TEST(Text, ExactNumbersAreReadBackExactly) {
    for (const double value : {0.1, -1.0 / 3.0, 1e-300, std::numeric_limits<double>::denorm_min(), 5e-324, 1.7e308})
        EXPECT_EQ(std::strtod(exact(value).c_str(), nullptr), value);
    for (const double value : {0.1, -0.0, 25.0, 1e16, 1e17, 2.5e-5, -1.7e308, std::numeric_limits<double>::infinity()})
        EXPECT_EQ(exact(value), formatted("%.17g", value));
}

TEST(Text, IsTurnedIntoLowerCaseWhereItIsAscii) {
    EXPECT_EQ(lower_case(".OBJ"), ".obj");
    EXPECT_EQ(lower_case("aZ[\u00c4"), "az[\u00c4");
}

TEST(Text, IsReadAsCharacters) {
    EXPECT_EQ(characters_of("a\u00e9\u0416\u4e2d\U0001F600"),
              (std::vector<char32_t>{U'a', U'\u00e9', U'\u0416', U'\u4e2d', U'\U0001F600'}));
    EXPECT_EQ(characters_of("\xe0\x80\x80\xed\xa0\x80"), (std::vector<char32_t>{0xFFFD, 0xFFFD}));
    EXPECT_EQ(characters_of("a\xc3"), (std::vector<char32_t>{U'a', 0xFFFD})) << "cut off";
    EXPECT_EQ(characters_of("\xff"
                            "b"),
              (std::vector<char32_t>{0xFFFD, U'b'}));
}

TEST(Text, WritesLargeNumbersWholeUntilTheyReadBetterWithAnExponent) {
    EXPECT_EQ(plain_number(12345.6, 4), "12346");
    EXPECT_EQ(plain_number(-999.5, 2), "-1000");
    EXPECT_EQ(plain_number(0.12346, 4), "0.1235");
    EXPECT_EQ(plain_number(999.4, 4), "999.4");
    EXPECT_EQ(plain_number(999999.6, 4), "1e+06");
    EXPECT_TRUE(reads_as_whole(-1e5));
    EXPECT_FALSE(reads_as_whole(-1e5, 99950.0));
    EXPECT_FALSE(reads_as_whole(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace elastolab
