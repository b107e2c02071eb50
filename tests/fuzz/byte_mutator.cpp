#include "fuzz/byte_mutator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace elastolab::fuzz {

namespace {

constexpr std::size_t kLongestFile = std::size_t{1} << 18;

constexpr std::array<std::uint64_t, 16> kIntegers = {0,
                                                     1,
                                                     2,
                                                     3,
                                                     0x7f,
                                                     0x80,
                                                     0xff,
                                                     0x7fff,
                                                     0x8000,
                                                     0xffff,
                                                     0x7fffffff,
                                                     0x80000000,
                                                     0xffffffff,
                                                     0x100000000,
                                                     0x7fffffffffffffff,
                                                     0xffffffffffffffff};
constexpr std::array<double, 14> kReals = {0.0,
                                           -0.0,
                                           1.0,
                                           -1.0,
                                           1e-12,
                                           1e12,
                                           1e-38,
                                           1e-45,
                                           3e38,
                                           1e-308,
                                           5e-324,
                                           1e308,
                                           std::numeric_limits<double>::infinity(),
                                           std::numeric_limits<double>::quiet_NaN()};

/// Bytes first to first + size.
struct Part {
    std::size_t first = 0, size = 0;
};

Part random_part(const std::string& bytes, std::size_t longest, Random& random) {
    const std::size_t first = random.below(bytes.size());
    return {first, std::min(1 + random.below(longest), bytes.size() - first)};
}

template <class Number>
std::string as_bytes(Number number) {
    std::string bytes(sizeof(number), '\0');
    std::memcpy(bytes.data(), &number, sizeof(number));
    return bytes;
}

/// A number of a binary format.
std::string number_bytes(Random& random) {
    std::string bytes;
    switch (random.below(4)) {
        case 0:
            bytes = as_bytes(static_cast<float>(random.pick(kReals)));
            break;
        case 1:
            bytes = as_bytes(random.pick(kReals));
            break;
        default:
            bytes = as_bytes(random.pick(kIntegers) + random.below(3) - 1);
            bytes.resize(std::array<std::size_t, 4>{1, 2, 4, 8}[random.below(4)]);
    }
    if (random.once_in(4)) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

void overwrite_number(std::string& bytes, Random& random) {
    const std::string number = number_bytes(random);
    const std::size_t first = random.below(bytes.size());
    bytes.replace(first, std::min(number.size(), bytes.size() - first), number);
}

void repeat_part(std::string& bytes, Random& random) {
    const Part part = random_part(bytes, 64, random);
    const std::string text = bytes.substr(part.first, part.size);
    const std::size_t n = random.once_in(8) ? 1 + random.below(2000) : 1 + random.below(3);
    std::string repeated;
    for (std::size_t i = 0; i < n; ++i) repeated += text;
    bytes.insert(part.first, repeated);
}

void move_part(std::string& bytes, Random& random) {
    const Part part = random_part(bytes, 64, random);
    const std::string text = bytes.substr(part.first, part.size);
    bytes.erase(part.first, part.size);
    bytes.insert(random.below(bytes.size() + 1), text);
}

}  // namespace

std::string mutate_bytes(std::string bytes, const std::string& other, Random& random) {
    if (bytes.empty()) return other;
    const auto any = [&]() -> char& { return bytes[random.below(bytes.size())]; };
    switch (random.below(10)) {
        case 0: {
            char& byte = any();
            byte = static_cast<char>(byte ^ (1 << random.below(8)));
            break;
        }
        case 1:
            any() = static_cast<char>(random.below(256));
            break;
        case 2:
            any() = "\0\n\r\t -.e9/\x7f\xff\x1b"[random.below(13)];
            break;
        case 3:
            bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(random.below(bytes.size() + 1)),
                         static_cast<char>(random.below(256)));
            break;
        case 4: {
            const Part part = random_part(bytes, random.once_in(4) ? 4096 : 16, random);
            bytes.erase(part.first, part.size);
            break;
        }
        case 5:
            repeat_part(bytes, random);
            break;
        case 6:
            move_part(bytes, random);
            break;
        case 7:
            bytes.resize(random.below(bytes.size()));
            break;
        case 8:
            overwrite_number(bytes, random);
            break;
        default:
            if (other.empty()) break;
            const Part part = random_part(other, 256, random);
            bytes.insert(random.below(bytes.size() + 1), other, part.first, part.size);
    }
    if (bytes.size() > kLongestFile) bytes.resize(kLongestFile);
    return bytes;
}

}  // namespace elastolab::fuzz
