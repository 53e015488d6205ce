#include "app/gui/runner/StepList.h"

#include <QEvent>
#include <QVBoxLayout>

#include "app/gui/runner/StepButton.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kRoomyWindow = 760;  // below this height steps have no notes
}

StepList::StepList(const QStringList& steps, QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Steps"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    for (const auto& step : steps) {
        const auto place = buttons_.empty()            ? StepButton::Place::First
                           : step == steps.constLast() ? StepButton::Place::Last
                                                       : StepButton::Place::Between;
        auto* button = new StepButton(step, place, this);
        connect(button, &StepButton::clicked, this, [this, index = int(buttons_.size())] { emit chosen(index); });
        column->addWidget(button);
        buttons_.push_back(button);
    }
    setShown(0);
}

void StepList::setState(int step, State state) { buttons_.at(std::size_t(step))->setState(state); }

StepList::State StepList::state(int step) const { return buttons_.at(std::size_t(step))->state(); }

void StepList::setNote(int step, const QString& note) { buttons_.at(std::size_t(step))->setNote(note); }

void StepList::setOutOfReach(int step, const QString& why) { buttons_.at(std::size_t(step))->setOutOfReach(why); }

void StepList::setStepVisible(int step, bool visible) { buttons_.at(std::size_t(step))->setVisible(visible); }

void StepList::setShown(int step) {
    shown_ = step;
    buttons_.at(std::size_t(step))->setChecked(true);
}

void StepList::focusShown() { buttons_.at(std::size_t(shown_))->setFocus(); }

void StepList::fit() {
    for (auto* button : buttons_) button->setLow(window()->height() < scaledPx(kRoomyWindow));
}

void StepList::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::FontChange) fit();
}

}  // namespace tacto::gui
