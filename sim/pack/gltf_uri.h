// URIs as glTF uses them: data inside the file, or a file name with %20 and the like.
#pragma once

#include <string>
#include <string_view>

namespace usuzumi::sim {

inline bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

inline std::string decoded_uri(std::string_view uri) {
  auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
      text += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

}  // namespace usuzumi::sim
