// SessionSide.h - what stands beside a session: who takes part, what their screen shows, and the stops.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QScrollArea>

namespace tacto::gui {

class FactsCard;
class SessionConduct;
class TheirScreen;

class SessionSide final : public QScrollArea {
    Q_OBJECT
public:
    explicit SessionSide(QWidget* parent = nullptr);
    void show(const SessionConduct& session);
    using QWidget::show;

private:
    FactsCard* who_;
    FactsCard* screen_;
    TheirScreen* theirs_;
    FactsCard* stops_;
};

}  // namespace tacto::gui
