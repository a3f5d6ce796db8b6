#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace vitrel {

/// A text that is refused, and a part of the message.
struct RefusedText {
  std::string text, message;
};

/// Those of a file, in which each text is followed by "=> " and the part of the message. Empty lines
/// are for the reader.
inline std::vector<RefusedText> refused_texts(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<RefusedText> found;
  std::string text;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("=> ")) {
      found.push_back({text, line.substr(3)});
      text.clear();
    } else if (!line.empty()) {
      text += line + '\n';
    }
  EXPECT_FALSE(found.empty()) << path;
  EXPECT_EQ(text, "") << path;
  return found;
}

}  // namespace vitrel
