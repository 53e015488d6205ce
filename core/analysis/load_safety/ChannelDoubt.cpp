#include "core/analysis/load_safety/ChannelDoubt.h"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace tacto {

namespace {

void addStated(BudgetRows& rows, std::string what, double value, double divisor, double sensitivity) {
    if (value == 0) return;  // the channel states that this error is zero
    rows.push_back({std::move(what), Distribution::Rectangular, value, divisor, sensitivity});
}

}  // namespace

double ChannelDoubt::gain() const { return channel_ != nullptr ? channel_->gainTolerance : kNaN; }

std::string ChannelDoubt::name() const { return channel_ != nullptr ? channel_->name : "current"; }

void ChannelDoubt::addGain(BudgetRows& rows, double sensitivity) const {
    addStated(rows, "gain of " + name(), gain(), kSqrt3, sensitivity);
    addProbe(rows, sensitivity);
}

void ChannelDoubt::addProbe(BudgetRows& rows, double sensitivity) const {
    addStated(rows, (name() == "current" ? "shunt of " : "probe of ") + name(),
              channel_ != nullptr ? channel_->probeTolerance : kNaN, kSqrt3, sensitivity);
}

void ChannelDoubt::addStep(BudgetRows& rows, const char* of, double sensitivity) const {
    const double step = channel_ != nullptr && channel_->lsb > 0 ? channel_->lsb : kNaN;
    addStated(rows, fmt::format("resolution of {}{}", name(), of), step, kSqrt12, sensitivity);
}

void ChannelDoubt::addLevel(BudgetRows& rows, double sensitivity) const {
    const double step = channel_ != nullptr && channel_->lsb > 0 ? channel_->lsb : kNaN;
    addStated(rows, "resolution of " + name(), step, kSqrt12 / kSqrt2, sensitivity);
    addStated(rows, "linearity of " + name(), channel_ != nullptr ? channel_->linearityTolerance : 0, kSqrt3,
              sensitivity);
}

void ChannelDoubt::addOpposites(BudgetRows& rows, double width_s) const {
    addStep(rows, ", leading phase", width_s);
    addStep(rows, ", second phase", width_s);
    addStep(rows, ", at its baseline", 2 * width_s);
}

void addNormal(BudgetRows& rows, const char* what, double u, double sensitivity) {
    rows.push_back({what, Distribution::Normal, u, 1, sensitivity});
}

void addSpread(BudgetRows& rows, const LoadTrains& trains, double TrainFigures::*member, double sensitivity) {
    const auto s = statisticsOver(trains, member);
    if (s.n < 2) return;
    rows.push_back({"spread of the trains", Distribution::Student, s.sd, std::sqrt(static_cast<double>(s.n)),
                    sensitivity, static_cast<double>(s.n - 1)});
}

}  // namespace tacto
