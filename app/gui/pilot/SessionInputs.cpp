#include "app/gui/pilot/SessionInputs.h"

#include <QStringList>
#include <algorithm>

#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {
constexpr int kButtonsOfOne = 1000;  // number of codes for the buttons of one device

QString unpluggedText(const SeatedDevice& seat) {
    const auto name = qtext(seat.device.name);
    return seat.whose == PromptTo::Participant ? SessionInputs::tr("the participant's %1 is unplugged").arg(name)
                                               : SessionInputs::tr("the operator's %1 is unplugged").arg(name);
}

/// Returns a listener that calls `atOnce` on the device's own thread.
ButtonListener listenerOf(const SeatedDevice& seat, int firstCode, const InputsAtOnce& atOnce) {
    ButtonListener listener;
    listener.moved = [seat, firstCode, atOnce](const ButtonPress& press) {
        if (press.button >= seat.uses.size()) return;
        const auto does = seat.uses[press.button].does;
        if (does == ButtonUse::Does::Stop && press.down && atOnce.stop) atOnce.stop(seat.whose);
        const bool holds = does == ButtonUse::Does::Hold && seat.whose == PromptTo::Participant;
        if (holds && atOnce.heldMoved) atOnce.heldMoved(firstCode + int(press.button), press.down, press.at);
        if (holds && !press.down && atOnce.letGo) atOnce.letGo(firstCode + int(press.button));
    };
    listener.plugged = [which = unpluggedText(seat).toStdString(), lost = atOnce.lost](bool there) {
        if (!there && lost) lost(which);
    };
    return listener;
}

}  // namespace

SessionInputs::SessionInputs(QObject* parent) : QObject(parent) {
    connect(&open_, &OpenButtons::moved, this, &SessionInputs::move);
    connect(&open_, &OpenButtons::plugged, this, &SessionInputs::plug);
}

QString SessionInputs::begin(const std::shared_ptr<const ButtonDevices>& devices,
                             const std::vector<SeatedDevice>& seats, const InputsAtOnce& atOnce) {
    end();
    open_.setDevices(devices);
    for (const auto& seat : seats) {
        const bool again =
            std::ranges::any_of(seats_, [&](const auto& one) { return one.device.identity == seat.device.identity; });
        if (again) {
            end();
            return tr("%1 is assigned twice; a device is one person’s.").arg(qtext(seat.device.name));
        }
        const int firstCode = int(seats_.size()) * kButtonsOfOne;
        if (const auto opened = open_.open(seat.device, listenerOf(seat, firstCode, atOnce)); !opened) {
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
        if (gone_.contains(seat.device.identity)) words << unpluggedText(seat);
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

OpenButtons::OpenButtons(QObject* parent) : QObject(parent) {}

OpenButtons::~OpenButtons() { close(); }

void OpenButtons::setDevices(std::shared_ptr<const ButtonDevices> devices) {
    close();
    devices_ = std::move(devices);
}

bool OpenButtons::isOpen(const std::string& identity, quint64 number) const {
    const auto found = open_.find(identity);
    return found != open_.end() && found->second.number == number;
}

Result<void> OpenButtons::open(const ButtonDeviceInfo& info, const ButtonListener& atOnce) {
    if (open_.contains(info.identity)) return {};
    if (!devices_) return fail(ErrorCode::NotFound, "{} ({}) is not plugged in any more.", info.name, info.identity);
    const auto number = ++number_;
    // Called on the device's thread: passes the event to the window's thread without waiting.
    ButtonListener listener;
    listener.moved = [this, number, identity = info.identity, first = atOnce.moved](const ButtonPress& press) {
        if (first) first(press);
        QMetaObject::invokeMethod(
            this,
            [this, number, identity, press] {
                if (isOpen(identity, number)) emit moved(identity, press.button, press.down, press.at);
            },
            Qt::QueuedConnection);
    };
    listener.plugged = [this, number, identity = info.identity, first = atOnce.plugged](bool there) {
        if (first) first(there);
        QMetaObject::invokeMethod(
            this,
            [this, number, identity, there] {
                if (isOpen(identity, number)) emit plugged(identity, there);
            },
            Qt::QueuedConnection);
    };
    auto opened = devices_->open(info, std::move(listener));
    if (!opened) return failure(opened);
    open_[info.identity] = {number, std::move(*opened)};
    return {};
}

void OpenButtons::close() { open_.clear(); }

void OpenButtons::close(const std::string& identity) { open_.erase(identity); }

}  // namespace tacto::gui

#include "moc_SessionInputs.cpp"
