#include "scenes/environment/radiance_header.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::size_t kLongestLine = 4096, kMostLines = 10'000;
constexpr std::size_t kLongestQuote = 60;

std::string quoted(std::string_view text) {
  return "\"" + printable(std::string(text.substr(0, kLongestQuote))) +
         (text.size() > kLongestQuote ? "...\"" : "\"");
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

// The next word, parted by blanks; empty at the end.
std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const std::string_view word = text.substr(0, text.find_first_of(" \t"));
  text.remove_prefix(word.size());
  return word;
}

template <typename Number>
std::optional<Number> number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

template <std::size_t kCount>
std::optional<std::array<double, kCount>> numbers(std::string_view text) {
  std::array<double, kCount> values{};
  for (double& value : values) {
    const std::optional<double> one = number<double>(take_word(text));
    if (!one || !std::isfinite(*one)) return std::nullopt;
    value = *one;
  }
  if (!trimmed(text).empty()) return std::nullopt;
  return values;
}

bool near(const std::array<double, 8>& a, const std::array<double, 8>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i] - b[i]) > 0.002) return false;
  }
  return true;
}

class RadianceHeaderReader {
 public:
  RadianceHeaderReader(std::string_view bytes, const std::filesystem::path& file)
      : bytes_(bytes), file_(file) {}

  RadianceHeader read() {
    take_line();  // "#?RADIANCE", or whichever program
    for (std::size_t lines = 1;; ++lines) {
      const std::string_view line = take_line();
      if (line.empty()) break;
      if (lines > kMostLines) fail("has a header of more than 10,000 lines");
      variable(line);
    }
    resolution(take_line());
    if (!format_) header_.remarks.push_back("has no FORMAT line; read as 32-bit_rle_rgbe");
    for (const double factor : header_.multiplied) {
      if (std::isfinite(factor) && factor > 0 && std::isfinite(1 / factor)) continue;
      fail("has EXPOSURE or COLORCORR lines whose product is out of range");
    }
    header_.pixels_at = at_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(file_, 0, "is a Radiance picture that " + problem, "copy or export the picture again");
  }

  std::string_view take_line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string_view::npos || end - at_ > kLongestLine) {
      fail("has no end of its header: damaged or cut off");
    }
    std::string_view line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  void variable(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) return;
    std::string_view name = line.substr(0, equals);
    while (name.ends_with(' ')) name.remove_suffix(1);  // a tab in front stays: it says "of an earlier file"
    const std::string_view value = trimmed(line.substr(equals + 1));
    if (name == "FORMAT") return format(value);
    if (name == "EXPOSURE") {
      const auto factor = numbers<1>(value);
      return multiply(
          line, factor ? std::optional<std::array<double, 3>>({(*factor)[0], (*factor)[0], (*factor)[0]})
                       : std::nullopt);
    }
    if (name == "COLORCORR") return multiply(line, numbers<3>(value));
    if (name == "GAMMA") return gamma(line, value);
    if (name == "PRIMARIES") return primaries(line, value);
  }

  void format(std::string_view value) {
    if (value != "32-bit_rle_rgbe" && value != "32-bit_rle_xyze") {
      fail("has the format " + quoted(value) + ", where 32-bit_rle_rgbe and 32-bit_rle_xyze are known");
    }
    const bool xyz = value == "32-bit_rle_xyze";
    if (format_ && xyz != header_.xyz) fail("has two FORMAT lines that differ");
    format_ = true;
    header_.xyz = xyz;
  }

  void multiply(std::string_view line, const std::optional<std::array<double, 3>>& factors) {
    if (!factors || (*factors)[0] <= 0 || (*factors)[1] <= 0 || (*factors)[2] <= 0) {
      header_.remarks.push_back("the line " + quoted(line) + " is no factor above 0; taken as 1");
      return;
    }
    for (std::size_t c = 0; c < 3; ++c) header_.multiplied[c] *= (*factors)[c];
  }

  // Not of the format, but written by some programs.
  void gamma(std::string_view line, std::string_view value) {
    const auto power = numbers<1>(value);
    if (power && (*power)[0] == 1) return;
    header_.remarks.push_back("the line " + quoted(line) +
                              " is not of the format and is not used: values are taken as linear");
  }

  void primaries(std::string_view line, std::string_view value) {
    // x, y of red, green, blue and white: the format's own, those of sRGB, and what Photoshop writes for
    // none.
    constexpr std::array<double, 8> kStandard{0.640, 0.330, 0.290, 0.600, 0.150, 0.060, 0.3333, 0.3333},
        kSrgb{0.640, 0.330, 0.300, 0.600, 0.150, 0.060, 0.3127, 0.3290}, kNone{};
    const auto given = numbers<8>(value);
    if (header_.xyz || (given && (near(*given, kStandard) || near(*given, kSrgb) || *given == kNone))) return;
    header_.remarks.push_back("the line " + quoted(line) + " is not used: colours are taken as sRGB's");
  }

  void resolution(std::string_view line) {
    std::string_view rest = line;
    const std::string_view slow = take_word(rest);
    const std::optional<int> scanlines = number<int>(take_word(rest));
    const std::string_view fast = take_word(rest);
    const std::optional<int> pixels = number<int>(take_word(rest));
    const auto axis = [](std::string_view word, char name) {
      return word.size() == 2 && (word[0] == '-' || word[0] == '+') && word[1] == name;
    };
    const bool rows = axis(slow, 'Y') && axis(fast, 'X'), columns = axis(slow, 'X') && axis(fast, 'Y');
    if ((!rows && !columns) || !scanlines || !pixels || *scanlines < 1 || *pixels < 1 ||
        !trimmed(rest).empty()) {
      fail("has the resolution " + quoted(line) + R"(, where one like "-Y 512 +X 1024" is expected)");
    }
    const std::string_view x = rows ? fast : slow, y = rows ? slow : fast;
    header_.layout = {*scanlines, *pixels, columns, x[0] == '-', y[0] == '+'};
  }

  std::string_view bytes_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
  bool format_ = false;
  RadianceHeader header_;
};

}  // namespace

RadianceHeader read_radiance_header(std::string_view bytes, const std::filesystem::path& file) {
  return RadianceHeaderReader(bytes, file).read();
}

}  // namespace herr
