#include "app/gui/pilot/SessionInputs.h"

#include <QStringList>
#include <algorithm>

#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {
constexpr int kButtonsOfOne = 1000;  // codes of a device's buttons
}

SessionInputs::SessionInputs(QObject* parent) : QObject(parent) {
    connect(&open_, &OpenButtons::moved, this, &SessionInputs::move);
    connect(&open_, &OpenButtons::plugged, this, &SessionInputs::plug);
}

QString SessionInputs::begin(const std::shared_ptr<const ButtonDevices>& devices,
                             const std::vector<SeatedDevice>& seats) {
    end();
    open_.setDevices(devices);
    for (const auto& seat : seats) {
        if (const auto opened = open_.open(seat.device); !opened) {
            end();
            return sentence(opened.error());
        }
        seats_.push_back(seat);
    }
    return {};
}

void SessionInputs::end() {
    open_.close();
    seats_.clear();
    gone_.clear();
}

int SessionInputs::participantAnswers() const {
    int most = 0;
    for (const auto& seat : seats_) {
        if (seat.whose == PromptTo::Participant) most = std::max(most, seat.answers());
    }
    return most;
}

QString SessionInputs::gone() const {
    QStringList words;
    for (const auto& seat : seats_) {
        if (!gone_.contains(seat.device.identity)) continue;
        const auto name = qtext(seat.device.name);
        words << (seat.whose == PromptTo::Participant ? tr("the participant's %1 is unplugged").arg(name)
                                                      : tr("the operator's %1 is unplugged").arg(name));
    }
    return words.join(tr(", and "));
}

void SessionInputs::move(const std::string& identity, std::size_t button, bool down, SteadyTime at) {
    const auto seat = std::ranges::find_if(seats_, [&](const auto& one) { return one.device.identity == identity; });
    if (seat == seats_.end() || button >= seat->uses.size()) return;
    const auto use = seat->uses[button];
    if (seat->whose == PromptTo::Operator) {
        if (down) emit operatorPressed(use);
        return;
    }
    const int code = int(seat - seats_.begin()) * kButtonsOfOne + int(button);
    emit participantMoved(code, use, down, at);
}

void SessionInputs::plug(const std::string& identity, bool there) {
    if (there == !gone_.contains(identity)) return;
    if (there) {
        gone_.erase(identity);
        emit back();
    } else {
        gone_.insert(identity);
        emit lost();
    }
}

}  // namespace tacto::gui

#include "moc_SessionInputs.cpp"
