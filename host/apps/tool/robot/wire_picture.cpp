#include "host/apps/tool/robot/wire_picture.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/os/files/markup_text.hpp"

namespace verp::tool {
namespace {

constexpr double kLeft = 70, kWide = 1000, kRight = 20;  // pixels, as all here
constexpr double kTop = 34, kRow = 30, kGap = 16, kBoxes = 110;
constexpr double kLetter = 6.2;   // of the small font
constexpr double kSeenBit = 1.2;  // narrower bits are drawn as one block
constexpr const char* kBoard = "#2563a8";
constexpr const char* kDevice = "#c2571a";

class WirePicture {
 public:
  WirePicture(std::span<const WirePacket> packets, bool can) : packets_(packets), can_(can) {
    begin_us_ = packets.front().begin_us;
    double end_us = begin_us_;
    for (const WirePacket& each : packets) end_us = std::max(end_us, each.end_us);
    span_us_ = 1.04 * (end_us - begin_us_);
    begin_us_ -= 0.02 * (end_us - begin_us_);
  }

  std::string draw(const std::string& title, const std::vector<WireSpan>& spans) {
    text(kLeft, 18, title, "font-size='14'");
    double y = kTop;
    for (const WireSpan& each : spans) arrow(each, y);
    if (!spans.empty()) y += 24;
    if (!can_) y = direction(y);
    y = can_ ? y : line(y);
    y = boxes(y);
    const double high = axis(y) + 12;
    return fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:.0f} {1:.0f}' width='{0:.0f}' "
        "height='{1:.0f}' font-family='sans-serif' font-size='11'>\n"
        "<rect width='100%' height='100%' fill='#ffffff'/>\n{2}</svg>\n",
        kLeft + kWide + kRight, high, svg_);
  }

 private:
  double x(double time_us) const { return kLeft + kWide * (time_us - begin_us_) / span_us_; }
  double begin_of_time() const { return packets_.front().begin_us; }

  void text(double at_x, double at_y, const std::string& words, const std::string& how = "") {
    svg_ += fmt::format("<text x='{:.1f}' y='{:.1f}' {}>{}</text>\n", at_x, at_y, how,
                        files::markup_text(words));
  }
  void block(double from_us, double to_us, double y, double height, const char* fill,
             const char* edge) {
    svg_ += fmt::format(
        "<rect x='{:.2f}' y='{:.1f}' width='{:.2f}' height='{:.1f}' fill='{}' stroke='{}'/>\n",
        x(from_us), y, x(to_us) - x(from_us), height, fill, edge);
  }
  void trace(const std::string& points) {
    svg_ += fmt::format("<polyline points='{}' fill='none' stroke='#22262b'/>\n", points);
  }
  void label(double y, const char* words) {
    text(kLeft - 8, y + 0.65 * kRow, words, "text-anchor='end'");
  }

  void arrow(const WireSpan& span, double y) {
    const double from = x(span.begin_us), to = x(span.end_us);
    svg_ += fmt::format(
        "<path d='M{0:.1f} {2:.1f}v12M{1:.1f} {2:.1f}v12M{0:.1f} {3:.1f}H{1:.1f}' fill='none' "
        "stroke='#5c6670'/>\n",
        from, to, y - 4, y + 2);
    text(std::max(from, kLeft) + 6, y - 2,
         fmt::format("{}: {:.1f} us", span.what, span.end_us - span.begin_us));
  }

  /// High while the board sends; packets without a pause between them are one pulse.
  double direction(double y) {
    label(y, "direction");
    std::string points = fmt::format("{:.2f},{:.1f}", kLeft, y + kRow);
    for (std::size_t i = 0; i < packets_.size(); ++i) {
      if (!packets_[i].board) continue;
      const double from = x(packets_[i].begin_us);
      while (i + 1 < packets_.size() && follows(packets_[i], packets_[i + 1])) ++i;
      const double to = x(packets_[i].end_us);
      points += fmt::format(" {0:.2f},{2:.1f} {0:.2f},{3:.1f} {1:.2f},{3:.1f} {1:.2f},{2:.1f}",
                            from, to, y + kRow, y);
    }
    trace(points + fmt::format(" {:.2f},{:.1f}", kLeft + kWide, y + kRow));
    return y + kRow + kGap;
  }

  static bool follows(const WirePacket& packet, const WirePacket& next) {
    return next.board && next.begin_us - packet.end_us < 0.001;
  }

  double line(double y) {
    label(y, "line");
    const WirePacket& first = packets_.front();
    const double bit_us = first.us() / (10.0 * static_cast<double>(first.bytes.size()));
    const bool seen = x(begin_us_ + bit_us) - kLeft >= kSeenBit;
    std::string points = fmt::format("{:.2f},{:.1f}", kLeft, y);
    for (const WirePacket& each : packets_) {
      if (seen) {
        for (std::size_t i = 0; i < each.bytes.size(); ++i) {
          points += levels(each.bytes[i], each.begin_us + 10 * bit_us * static_cast<double>(i),
                           bit_us, y);
        }
      } else {
        block(each.begin_us, each.end_us, y, kRow, "#22262b", "none");
      }
    }
    trace(points + fmt::format(" {:.2f},{:.1f}", kLeft + kWide, y));
    return y + kRow + kGap;
  }
  /// Start bit low, eight data bits from the lowest, stop bit high.
  std::string levels(std::uint8_t byte, double begin_us, double bit_us, double y) const {
    std::string points;
    const unsigned bits = 1U << 9 | unsigned{byte} << 1;
    bool before = true;
    for (int i = 0; i < 10; ++i) {
      const bool high = (bits >> i & 1) != 0;
      const double at = x(begin_us + bit_us * i);
      if (high != before) {
        points += fmt::format(" {0:.2f},{1:.1f} {0:.2f},{2:.1f}", at, before ? y : y + kRow,
                              high ? y : y + kRow);
      }
      before = high;
    }
    return points;
  }

  double boxes(double y) {
    label(y, "decoded");
    const double room = std::max(kRow, names_height());
    for (const WirePacket& each : packets_) {
      block(each.begin_us, each.end_us, y, room, "#ffffff", each.board ? kBoard : kDevice);
      const double from = x(each.begin_us), width = x(each.end_us) - from;
      const char* colour = each.board ? kBoard : kDevice;
      if (fits(each)) {
        text(from + width / 2, y + 0.65 * kRow, each.name,
             fmt::format("text-anchor='middle' fill='{}'", colour));
      } else if (width >= 11) {
        text(0, 0, each.name,
             fmt::format("transform='translate({:.1f},{:.1f}) rotate(-90)' fill='{}'",
                         from + width / 2 + 4, y + room - 4, colour));
      }
      hexadecimal(each, y + room);
    }
    return y + room + kGap + 6;
  }
  bool fits(const WirePacket& each) const {
    return x(each.end_us) - x(each.begin_us) > kLetter * static_cast<double>(each.name.size());
  }
  double names_height() const {
    double height = 0;
    for (const WirePacket& each : packets_) {
      if (!fits(each)) height = std::max(height, kLetter * static_cast<double>(each.name.size()));
    }
    return std::min(height + 8, kBoxes);
  }
  void hexadecimal(const WirePacket& each, double y) {
    const double width =
        (x(each.end_us) - x(each.begin_us)) / static_cast<double>(each.bytes.size());
    if (can_ || width < 2.4 * kLetter) return;
    for (std::size_t i = 0; i < each.bytes.size(); ++i) {
      text(x(each.begin_us) + width * (static_cast<double>(i) + 0.5), y + 13,
           fmt::format("{:02X}", each.bytes[i]), "text-anchor='middle'");
    }
  }

  double axis(double y) {
    double step_us = std::pow(10, std::floor(std::log10(span_us_)));
    while (span_us_ / step_us < 8) step_us /= span_us_ / step_us < 4 ? 5 : 2;
    svg_ += fmt::format("<path d='M{:.1f} {:.1f}h{:.1f}' stroke='#22262b'/>\n", kLeft, y, kWide);
    for (double at_us = 0; begin_of_time() + at_us <= begin_us_ + span_us_; at_us += step_us) {
      const double at = x(begin_of_time() + at_us);
      svg_ += fmt::format("<path d='M{:.1f} {:.1f}v5' stroke='#22262b'/>\n", at, y);
      text(at, y + 17, fmt::format("{:g}", at_us), "text-anchor='middle'");
    }
    text(kLeft - 8, y + 17, "us", "text-anchor='end'");
    return y + 17;
  }

  std::span<const WirePacket> packets_;
  bool can_;
  double begin_us_ = 0, span_us_ = 0;
  std::string svg_;
};

}  // namespace

std::string draw_wire(const std::string& title, std::span<const WirePacket> packets,
                      const std::vector<WireSpan>& spans, bool can) {
  return WirePicture(packets, can).draw(title, spans);
}

}  // namespace verp::tool
