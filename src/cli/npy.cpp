#include "cli/npy.hpp"

#include <bit>
#include <string>

namespace elastolab {

static_assert(std::endian::native == std::endian::little, "matrices are written as they lie in memory");

void write_npy(std::ostream& out, const Eigen::MatrixXd& matrix) {
    constexpr std::size_t kAlignment = 64;
    constexpr std::size_t kPrefix = 10;  // magic, version, header length
    std::string header = "{'descr': '<f8', 'fortran_order': True, 'shape': (" + std::to_string(matrix.rows()) + ", " +
                         std::to_string(matrix.cols()) + "), }";
    header.append(kAlignment - (kPrefix + header.size() + 1) % kAlignment, ' ');
    header += '\n';
    const auto length = static_cast<unsigned>(header.size());
    out.write("\x93NUMPY\x01\x00", 8);
    out.put(static_cast<char>(length & 0xff)).put(static_cast<char>(length >> 8));
    out << header;
    out.write(reinterpret_cast<const char*>(matrix.data()),
              static_cast<std::streamsize>(matrix.size() * static_cast<Eigen::Index>(sizeof(double))));
}

}  // namespace elastolab
