#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

namespace elastolab::test {

inline std::string decoded(const std::string& text) {
    static const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (text.size() % 4 != 0) throw std::runtime_error("base64 comes in groups of four");
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); i += 4) {
        std::uint32_t bits = 0;
        int n = 0;
        for (std::size_t j = i; j < i + 4; ++j) {
            const std::size_t value = letters.find(text[j]);
            bits = bits << 6 | (value == std::string::npos ? 0u : static_cast<std::uint32_t>(value));
            n += text[j] != '=' ? 1 : 0;
        }
        for (int j = 0; j < n - 1; ++j) bytes += static_cast<char>(bits >> (16 - 8 * j) & 0xffu);
    }
    return bytes;
}

/// A DataArray of a VTK XML file, as its specification has it: a 64 bit count of bytes, then these.
struct VtkArray {
    std::string type, section;
    int n_components = 0;
    std::string bytes;

    template <class T>
    std::vector<T> as() const {
        std::vector<T> values(bytes.size() / sizeof(T));
        std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
};

struct VtkFile {
    std::string kind;
    std::map<std::string, int> counts;
    std::map<std::string, VtkArray> arrays;         ///< by "section/name"
    std::map<std::string, std::string> attributes;  ///< of the last tag of each name
    std::map<std::string, std::string> facts;       ///< of the field data: what their tags hold
};

/// Every tag in turn; an end tag that does not belong to the last open one is an error.
inline VtkFile read_vtk(const std::string& text) {
    VtkFile file;
    std::vector<std::string> open;
    const std::regex tag(R"(<(/?)([A-Za-z]+)((?:\s+[A-Za-z_0-9]+="[^"]*")*)\s*(/?)>)"),
        pair(R"rx(([A-Za-z_0-9]+)="([^"]*)")rx");
    auto at = std::sregex_iterator(text.begin(), text.end(), tag);
    for (; at != std::sregex_iterator(); ++at) {
        const std::string name = (*at)[2], attributes = (*at)[3];
        if ((*at)[1].length() > 0) {
            if (open.empty() || open.back() != name) throw std::runtime_error("</" + name + "> closes nothing");
            open.pop_back();
            continue;
        }
        std::map<std::string, std::string> values;
        for (auto p = std::sregex_iterator(attributes.begin(), attributes.end(), pair); p != std::sregex_iterator();
             ++p)
            values[(*p)[1]] = (*p)[2];
        if (name == "VTKFile") {
            file.kind = values.at("type");
            if (values.at("byte_order") != "LittleEndian" || values.at("header_type") != "UInt64")
                throw std::runtime_error("unknown layout");
        }
        if (name == "Piece")
            for (const auto& [key, value] : values) file.counts[key] = std::stoi(value);
        file.attributes[name] = attributes;
        if (name == "DataArray" && !open.empty() && open.back() == "FieldData") {
            const auto begin = static_cast<std::size_t>(at->position() + at->length());
            file.facts[values.at("Name")] = text.substr(begin, text.find('<', begin) - begin);
        } else if (name == "DataArray") {
            if (values.at("format") != "binary") throw std::runtime_error("unknown format");
            const auto begin = static_cast<std::size_t>(at->position() + at->length());
            const std::string bytes = decoded(text.substr(begin, text.find('<', begin) - begin));
            std::uint64_t n = 0;
            std::memcpy(&n, bytes.data(), sizeof n);
            if (n + sizeof n != bytes.size()) throw std::runtime_error(values.at("Name") + ": wrong count of bytes");
            file.arrays[open.back() + "/" + values.at("Name")] = {
                values.at("type"), open.back(), std::stoi(values.at("NumberOfComponents")), bytes.substr(sizeof n)};
        }
        open.push_back(name);
    }
    if (!open.empty()) throw std::runtime_error("<" + open.back() + "> is not closed");
    return file;
}

}  // namespace elastolab::test
