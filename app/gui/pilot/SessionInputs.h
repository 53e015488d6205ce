// SessionInputs.h - the game pads and foot switches of a session: each press goes to the one person whom its device is
// assigned to, and one that is unplugged is told.
//
// No other device is open, so none answers.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QObject>
#include <set>
#include <vector>

#include "app/gui/pilot/ButtonUse.h"
#include "app/gui/pilot/OpenButtons.h"

namespace tacto::gui {

class SessionInputs final : public QObject {
    Q_OBJECT
public:
    explicit SessionInputs(QObject* parent = nullptr);
    /// Opens all, or none; why not, a sentence.
    [[nodiscard]] QString begin(const std::shared_ptr<const ButtonDevices>& devices,
                                const std::vector<SeatedDevice>& seats);
    void end();
    /// How many answers, from 1, the participant's devices reach.
    [[nodiscard]] int participantAnswers() const;
    /// Which devices are unplugged, half a sentence; empty for none.
    [[nodiscard]] QString gone() const;

signals:
    /// `code`: the same for the same button.
    void participantMoved(int code, const tacto::gui::ButtonUse& use, bool down, tacto::gui::SteadyTime at);
    void operatorPressed(const tacto::gui::ButtonUse& use);
    void lost();  ///< an assigned device was unplugged: gone() names it
    void back();

private:
    void move(const std::string& identity, std::size_t button, bool down, SteadyTime at);
    void plug(const std::string& identity, bool there);
    OpenButtons open_;
    std::vector<SeatedDevice> seats_;
    std::set<std::string> gone_;
};

}  // namespace tacto::gui
