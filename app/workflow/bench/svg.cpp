#include "app/workflow/bench/svg.h"

#include <fmt/format.h>

#include <array>

#include "workflow/report/html.h"

namespace vitrel {
namespace {

struct Shade {
  const char* name;
  const char* light;
};

Shade shade(Tone tone) {
  switch (tone) {
    case Tone::ink:
      return {"ink", "#1b1f24"};
    case Tone::quiet:
      return {"quiet", "#59636e"};
    case Tone::grid:
      return {"grid", "#dfe3e8"};
    case Tone::ground:
      break;
  }
  return {"ground", "#ffffff"};
}

std::string painted(const char* property, Tone tone) {
  const Shade paint = shade(tone);
  return fmt::format(" class=\"vitrel-{}-{}\" {}=\"{}\"", property, paint.name, property,
                     paint.light);
}

const char* const dark_scheme =
    "<style>@media (prefers-color-scheme: dark) {"
    ".vitrel-fill-ink{fill:#e7eaee}.vitrel-fill-quiet{fill:#a1abb6}.vitrel-fill-ground{fill:#"
    "181c20}"
    ".vitrel-stroke-ink{stroke:#e7eaee}.vitrel-stroke-quiet{stroke:#a1abb6}"
    ".vitrel-stroke-grid{stroke:#30373f}.vitrel-stroke-ground{stroke:#181c20}}</style>";

}  // namespace

std::string svg_opening(int width, int height, std::string_view description) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\" aria-label=\"{2}\" font-family=\"system-ui, 'Segoe UI', "
      "Roboto, 'Noto Sans', 'DejaVu Sans', sans-serif\">\n{3}\n<rect width=\"{0}\" "
      "height=\"{1}\"{4}/>\n",
      width, height, escaped(description), dark_scheme, fill(Tone::ground));
}

std::string fill(Tone tone) {
  return painted("fill", tone);
}

std::string stroke(Tone tone) {
  return painted("stroke", tone);
}

std::string fill_and_stroke(Tone inside, Tone outline) {
  const Shade one = shade(inside), two = shade(outline);
  return fmt::format(" class=\"vitrel-fill-{} vitrel-stroke-{}\" fill=\"{}\" stroke=\"{}\"",
                     one.name, two.name, one.light, two.light);
}

std::string svg_text(double x, double y, std::string_view text, Anchor anchor, Tone tone,
                     int size) {
  const char* const anchors[] = {"start", "middle", "end"};
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\"{}>{}</text>\n", x, y,
      anchors[static_cast<int>(anchor)], size, fill(tone), escaped(text));
}

std::string_view series_colour(std::size_t index) {
  // After Okabe and Ito, with the pale ones darkened until they stand out on white.
  static constexpr std::array<std::string_view, 11> colours = {
      "#1f78c8", "#d55e00", "#0b8f6a", "#b4609b", "#a87900", "#3a9bc9",
      "#7a828b", "#8a5a44", "#6a5fd0", "#c8374d", "#5f8f1f"};
  return colours[index % colours.size()];
}

}  // namespace vitrel
