#pragma once

#include <string>
#include <string_view>

namespace vitrel {

/// The start of a picture that is a file of its own as well as a part of a page: size in pixels, a
/// description for those who cannot see it, and classes for strokes and fills that follow the
/// reader's light or dark scheme. Programs that know no style sheets see the light one.
std::string svg_opening(int width, int height, std::string_view description);

/// Attributes of an element: ` class="vitrel-fill-ink" fill="#1b1f24"`; one of them per element.
enum class Tone { ink, quiet, grid, ground };
std::string fill(Tone tone);
std::string stroke(Tone tone);
std::string fill_and_stroke(Tone inside, Tone outline);

enum class Anchor { start, middle, end };
std::string svg_text(double x, double y, std::string_view text, Anchor anchor = Anchor::start,
                     Tone tone = Tone::ink, int size = 13);

/// Colours told apart by colour-blind eyes too, on light and on dark ground; they repeat.
std::string_view series_colour(std::size_t index);

}  // namespace vitrel
