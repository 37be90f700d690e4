#include "scenes/environment/exr_layers.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr std::size_t kMostNamed = 6;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

// "ViewLayer.Combined.R" -> "ViewLayer.Combined" and "R".
std::string_view layer_of(std::string_view channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : channel.substr(0, dot);
}
std::string own_name(std::string_view channel) {
  return lower_case(channel.substr(channel.rfind('.') + 1));  // npos + 1 is 0
}

struct ExrLayer {
  std::string name;
  std::optional<std::size_t> red, green, blue, grey;
  bool opponent_colours = false;  // RY and BY beside Y, or Y is an axis
  bool coloured() const { return red && green && blue; }
};

std::vector<ExrLayer> layers_of(const std::vector<ExrChannel>& channels) {
  std::vector<ExrLayer> layers;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string_view layer = layer_of(channels[i].name);
    auto found =
        std::find_if(layers.begin(), layers.end(), [&](const ExrLayer& one) { return one.name == layer; });
    if (found == layers.end()) {
      layers.emplace_back().name = std::string(layer);
      found = layers.end() - 1;
    }
    const std::string name = own_name(channels[i].name);
    if (name == "r" || name == "red") found->red = i;
    if (name == "g" || name == "green") found->green = i;
    if (name == "b" || name == "blue") found->blue = i;
    if (name == "y") found->grey = i;
    if (name == "ry" || name == "by" || name == "x") found->opponent_colours = true;
  }
  return layers;
}

const ExrLayer* chosen(const std::vector<ExrLayer>& layers) {
  const auto first = [&](const auto& fits) -> const ExrLayer* {
    const auto found = std::find_if(layers.begin(), layers.end(), fits);
    return found == layers.end() ? nullptr : &*found;
  };
  const ExrLayer* layer = first([](const ExrLayer& one) { return one.name.empty() && one.coloured(); });
  if (layer == nullptr) {
    layer = first([](const ExrLayer& one) { return one.coloured() && own_name(one.name) == "combined"; });
  }
  if (layer == nullptr) layer = first([](const ExrLayer& one) { return one.coloured(); });
  if (layer != nullptr) return layer;
  const auto grey = [](const ExrLayer& one) { return one.grey && !one.opponent_colours; };
  layer = first([&](const ExrLayer& one) { return one.name.empty() && grey(one); });
  return layer != nullptr ? layer : first(grey);
}

std::string names(const std::vector<std::string>& channels) {
  std::string text;
  for (std::size_t i = 0; i < std::min(channels.size(), kMostNamed); ++i) {
    text += (i > 0 ? ", " : "") + printable(channels[i]);
  }
  if (channels.size() > kMostNamed) text += " and " + std::to_string(channels.size() - kMostNamed) + " more";
  return text;
}

void check_samples(const ExrLayout& layout, const std::array<std::size_t, 3>& used,
                   const std::filesystem::path& file) {
  // A subsampled channel anywhere moves all others within a scanline.
  for (const ExrChannel& channel : layout.channels) {
    if (!channel.subsampled) continue;
    throw InputError(file, 0, "is an EXR whose channel " + printable(channel.name) + " is subsampled",
                     "save every channel at full size");
  }
  for (const std::size_t i : used) {
    if (layout.channels[i].stored != SampleType::other) continue;
    throw InputError(file, 0,
                     "is an EXR whose channel " + printable(layout.channels[i].name) + " holds integers",
                     "use half or float");
  }
}

}  // namespace

std::array<std::size_t, 3> environment_channels(const ExrLayout& layout, const std::filesystem::path& file,
                                                std::vector<std::string>& remarks) {
  const std::vector<ExrLayer> layers = layers_of(layout.channels);
  const ExrLayer* layer = chosen(layers);
  std::vector<std::string> all;
  for (const ExrChannel& channel : layout.channels) all.push_back(channel.name);
  if (layer == nullptr) {
    throw InputError(file, 0, "is an EXR whose channels (" + names(all) + ") are neither R, G, B nor Y",
                     "name the colours of one layer R, G and B: oiiotool IN.exr --ch R=NAME,G=NAME,B=NAME -o "
                     "OUT.exr");
  }
  const std::array<std::size_t, 3> used = layer->coloured()
                                              ? std::array{*layer->red, *layer->green, *layer->blue}
                                              : std::array{*layer->grey, *layer->grey, *layer->grey};
  check_samples(layout, used, file);

  std::vector<std::string> unused;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool alpha = layer_of(all[i]) == layer->name && own_name(all[i]) == "a";
    if (!alpha && std::find(used.begin(), used.end(), i) == used.end()) unused.push_back(all[i]);
  }
  if (!unused.empty()) {
    std::vector<std::string> shown{all[used[0]]};
    if (used[1] != used[0]) shown.insert(shown.end(), {all[used[1]], all[used[2]]});
    remarks.push_back("shows the channels " + names(shown) + "; not used: " + names(unused));
  }
  return used;
}

}  // namespace herr
