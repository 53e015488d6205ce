#include "app/gui/live/TrainGraphs.h"

#include <algorithm>
#include <cmath>

#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

/// If a train was due this shortly before a fault, the fault has cut the train, and its line says so.
constexpr double kFaultTakes_s = 0.25;
constexpr int kAroundWords = 8;  // pixels

template <class Container>
std::vector<double> valuesOf(const Container& data) {
    std::vector<double> values;
    for (auto point = data.constBegin(); point != data.constEnd(); ++point) values.push_back(point->value);
    return values;
}

}  // namespace

TrainGraphs::TrainGraphs(Strip& strip)
    : strip_(strip),
      command_(strip.time().parentPlot()->addGraph(&strip.time(), &strip.values())),
      delivered_(new QCPBars(&strip.time(), &strip.values())) {
    command_->setLineStyle(QCPGraph::lsStepLeft);
    delivered_->setWidthType(QCPBars::wtAbsolute);
    delivered_->setWidth(3);
    for (auto** graph : {&measured_, &scoped_, &failed_, &board_}) {
        *graph = strip.time().parentPlot()->addGraph(&strip.time(), &strip.values());
        (*graph)->setLineStyle(QCPGraph::lsNone);
    }
    off_ = new QCPItemRect(strip.time().parentPlot());
    offSays_ = new QCPItemText(strip.time().parentPlot());
    offSays_->setText(QObject::tr("output off"));
    for (auto* place : {off_->topLeft, off_->bottomRight, offSays_->position}) placeAcross(*place, strip.axes());
    for (QCPAbstractItem* item : {static_cast<QCPAbstractItem*>(off_), static_cast<QCPAbstractItem*>(offSays_)}) {
        item->setClipAxisRect(&strip.axes());
        item->setVisible(false);
    }
    off_->setLayer("grid");
    off_->setPen(Qt::NoPen);
}

void TrainGraphs::begin() { readings_.clear(); }

void TrainGraphs::addScopeReading(double t_s, double amplitude) {
    if (readings_.size() == kReadings) readings_.pop_front();
    readings_.emplace_back(t_s, amplitude);
}

void TrainGraphs::draw(const LiveHistory& history, const QCPRange& time) {
    drawCommand(history, time);
    drawTrains(history, time);
    drawOff(history, time);
}

void TrainGraphs::drawOff(const LiveHistory& history, const QCPRange& time) {
    const auto& fault = history.fault();
    const double from = fault ? std::max(fault->at_s, time.lower) : time.upper;
    const double to = fault ? std::min(fault->until_s, time.upper) : time.upper;
    off_->setVisible(to > from);
    const auto pixels = strip_.axes().width() * (to - from) / time.size();
    offSays_->setVisible(to > from &&
                         QFontMetrics(offSays_->font()).horizontalAdvance(offSays_->text()) + kAroundWords < pixels);
    if (!off_->visible()) return;
    off_->topLeft->setCoords(from, 0);
    off_->bottomRight->setCoords(to, 1);
    offSays_->position->setCoords((from + to) / 2, 0.5);
}

std::optional<QCPRange> TrainGraphs::shownOff() const {
    if (!off_->visible()) return {};
    return QCPRange(off_->topLeft->key(), off_->bottomRight->key());
}

void TrainGraphs::drawCommand(const LiveHistory& history, const QCPRange& time) {
    const bool milliamps = strip_.unit() == "mA";
    const auto& commands = history.commands();
    at_.clear();
    value_.clear();
    std::size_t first = commands.firstFrom(time.lower);
    if (first > 0) --first;
    for (std::size_t i = first; i < commands.size() && commands.time(i) <= time.upper; ++i) {
        const double volts = double(commands.value(i, LiveHistory::kAmplitude_v));
        const double value = milliamps ? 1e3 * volts / double(commands.value(i, LiveHistory::kImpedance_ohm)) : volts;
        // A step line needs points only at its corners.
        if (!value_.isEmpty() && (value == value_.back() || (std::isnan(value) && std::isnan(value_.back())))) continue;
        at_ << commands.time(i);
        value_ << value;
    }
    if (!value_.isEmpty() && !std::isnan(value_.back()) && commands.newest() > at_.back()) {
        at_ << commands.newest();
        value_ << double(value_.back());
    }
    command_->setData(at_, value_, true);
}

void TrainGraphs::drawTrains(const LiveHistory& history, const QCPRange& time) {
    double most = 0;
    for (auto* list : {&at_, &value_, &measuredAt_, &measuredValue_, &failedAt_, &failedValue_}) list->clear();
    for (const auto& train : history.trains()) {
        const double t = toSeconds(train.onset);
        if (!time.contains(t) || train.isCheck) continue;
        if (train.outcome != TrainOutcome::Delivered) {
            const auto& fault = history.fault();
            if (fault && t >= fault->at_s - kFaultTakes_s && t <= fault->until_s) continue;
            failedAt_ << t;
            failedValue_ << train.amplitude;
            continue;
        }
        at_ << t;
        value_ << train.amplitude;
        most = std::max(most, train.amplitude);
        if (!std::isfinite(train.measured)) continue;
        measuredAt_ << t;
        measuredValue_ << train.measured;
        most = std::max(most, train.measured);
    }
    delivered_->setData(at_, value_, true);
    measured_->setData(measuredAt_, measuredValue_, true);
    failed_->setData(failedAt_, failedValue_, true);
    scoped_->data()->clear();
    for (const auto& reading : readings_) {
        if (time.contains(reading.key)) scoped_->data()->add(reading);
    }
    board_->data()->clear();
    for (const auto& train : history.boardTrains()) {
        if (!time.contains(train.onset_s)) continue;
        board_->data()->add({train.onset_s, train.amplitude});
        most = std::max(most, train.amplitude);
    }
    for (const auto& point : *command_->data()) {
        if (std::isfinite(point.value)) most = std::max(most, point.value);
    }
    auto& axis = strip_.values();
    if (most > 0) axis.setRange(steadyRange(axis.range(), QCPRange(0, most * 1.3)));
}

void TrainGraphs::colour() {
    const auto& c = colours();
    const auto points = [](QCPScatterStyle::ScatterShape shape, const QColor& colour, double width, double size) {
        return QCPScatterStyle(shape, QPen(colour, width), Qt::NoBrush, size);
    };
    command_->setPen(QPen(c.quiet, 1, Qt::DashLine));
    delivered_->setPen(Qt::NoPen);
    delivered_->setBrush(c.voltage);
    measured_->setScatterStyle(points(QCPScatterStyle::ssCircle, c.text, 1, 7));
    scoped_->setScatterStyle(points(QCPScatterStyle::ssDiamond, c.third, 1.5, 9));
    failed_->setScatterStyle(points(QCPScatterStyle::ssCross, c.amber, 1.5, 8));
    board_->setScatterStyle(points(QCPScatterStyle::ssTriangle, c.third, 1.5, 8));
    off_->setBrush(c.sunken);
    offSays_->setColor(c.text);
    offSays_->setFont(textFont(TextSize::Small, QFont::DemiBold));
    auto& keys = strip_.caption();
    keys.setSample(0, command_->pen());
    keys.setSample(1, QPen(c.voltage, 3));
    keys.setSample(2, Qt::NoPen, failed_->scatterStyle());
    keys.setSample(3, Qt::NoPen, measured_->scatterStyle());
    keys.setSample(4, Qt::NoPen, scoped_->scatterStyle());
    keys.setSample(5, Qt::NoPen, board_->scatterStyle());
}

void TrainGraphs::caption() const {
    auto& keys = strip_.caption();
    keys.setKey(0, QObject::tr("commanded"), QObject::tr("asked"));
    keys.setKey(1, QObject::tr("delivered"), QObject::tr("given"));
    // Failures come before confirmations, since the last keys are left out if there is no room.
    keys.setKey(2, failedAt_.isEmpty() ? QString() : QObject::tr("not delivered"), QObject::tr("not given"));
    keys.setKey(3, measuredAt_.isEmpty() ? QString() : QObject::tr("read back"), QObject::tr("read"));
    keys.setKey(4, scoped_->data()->isEmpty() ? QString() : QObject::tr("oscilloscope"), QObject::tr("scope"));
    keys.setKey(5, board_->data()->isEmpty() ? QString() : QObject::tr("as the board encodes"), QObject::tr("board"));
}

std::vector<double> TrainGraphs::shownTrains() const { return valuesOf(*delivered_->data()); }
std::vector<double> TrainGraphs::shownCommand() const { return valuesOf(*command_->data()); }
std::vector<double> TrainGraphs::boardTrains() const { return valuesOf(*board_->data()); }
std::vector<double> TrainGraphs::scopeReadings() const { return valuesOf(*scoped_->data()); }

}  // namespace tacto::gui
