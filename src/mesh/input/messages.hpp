#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace elastolab {

/// Appends `count` values to what is to be sent to a helper program, as they are in memory.
template <class T>
void append_bytes(std::string& bytes, const T* values, std::size_t count) {
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof(T) * count);
    if (count > 0) std::memcpy(bytes.data() + end, values, sizeof(T) * count);
}

/// Reads what a helper program has answered, value by value. The caller has compared the size before.
class ReplyReader {
public:
    explicit ReplyReader(const std::vector<char>& bytes) : next_(bytes.data()) {}
    template <class T>
    void read(T* values, std::size_t count) {
        if (count > 0) std::memcpy(values, next_, sizeof(T) * count);
        next_ += sizeof(T) * count;
    }

private:
    const char* next_;
};

}  // namespace elastolab
