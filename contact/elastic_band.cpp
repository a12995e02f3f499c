#include "contact/elastic_band.hpp"

#include <algorithm>
#include <cmath>

namespace bulbus::inline contact {
namespace {

constexpr double balanced = 1e-4;  // of the hoop force: below the digits that figures are given with
constexpr int most_secants = 20;   // the secant method takes three or four

}  // namespace

void ElasticBand::shorten(double circumference, double by) {
  if (!touches()) circumference_ = circumference, rate_ = 1 / shortening_;  // as if it did not stretch
  to_ = from_ + by;
}

double ElasticBand::tension() const {
  return stiffness_ * std::max(0., shortened_ - shortening_ * closed_) / length();
}

void ElasticBand::set_progress(double s) {
  shortened_ = from_ + s * (to_ - from_);
  closed_ = kept_ + (ahead_ ? *ahead_ * change_ : rate_ * (shortened_ - kept_shortened_));
  ahead_.reset();
  last_.reset();
  updates_ = 0;
  gave_up_ = false;
}

bool ElasticBand::balance(double pressed) {
  const double excess = pressed - tension();
  if (std::abs(excess) <= balanced * std::max(pressed, tension())) return false;
  if (updates_ == most_secants) return gave_up_ = true, false;
  ++updates_;
  if (last_ && closed_ != last_->closed) {
    const double slope = (pressed - last_->pressed) / (closed_ - last_->closed);
    if (slope > 0) slope_ = slope;
  } else if (slope_ == 0 && closed_ > 0) {
    slope_ = pressed / closed_;
  }
  last_ = {closed_, pressed};
  closed_ -= excess / (slope_ + shortening_ * stiffness_ / length());
  return true;
}

void ElasticBand::commit() {
  if (shortened_ != kept_shortened_) rate_ = (closed_ - kept_) / (shortened_ - kept_shortened_);
  change_ = closed_ - kept_;
  kept_ = closed_, kept_shortened_ = shortened_;
}

void ElasticBand::freeze() {
  from_ = to_;
  closed_before_ = closed_;
}

void ElasticBand::serialize(Archive& archive) {
  archive.scalars("band", circumference_, closed_, closed_before_, kept_, kept_shortened_, rate_, slope_);
  if (!archive.reading() || archive.knows("change")) archive.scalars("change", change_);
}

}  // namespace bulbus::inline contact
