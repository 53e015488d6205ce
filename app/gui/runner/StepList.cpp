#include "app/gui/runner/StepList.h"

#include <utility>

#include "app/gui/runner/StepButton.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kRoomyWindow = 760;  // below this height steps have no notes
}

StepList::StepList(const QStringList& steps, QWidget* parent)
    : QWidget(parent), layout_(new QBoxLayout(QBoxLayout::TopToBottom, this)) {
    setAccessibleName(tr("Steps"));
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(0);
    for (const auto& step : steps) {
        const bool isLast = int(buttons_.size()) == steps.size() - 1;
        const auto place = buttons_.empty() ? StepButton::Place::First
                           : isLast         ? StepButton::Place::Last
                                            : StepButton::Place::Between;
        auto* button = new StepButton(step, int(buttons_.size()) + 1, place, this);
        connect(button, &StepButton::clicked, this, [this, index = int(buttons_.size())] { emit chosen(index); });
        layout_->addWidget(button);
        buttons_.push_back(button);
    }
    setShown(0);
    onFontChange(*this, [this] { fit(); });
    onEvent(*this, QEvent::Resize, [this] { placeAcross(); });
}

void StepList::setState(int step, State state) { buttons_.at(std::size_t(step))->setState(state); }

StepList::State StepList::state(int step) const { return buttons_.at(std::size_t(step))->state(); }

void StepList::setNote(int step, const QString& note) { buttons_.at(std::size_t(step))->setNote(note); }

void StepList::setOutOfReach(int step, const QString& why) { buttons_.at(std::size_t(step))->setOutOfReach(why); }

void StepList::setName(int step, const QString& name) {
    buttons_.at(std::size_t(step))->setName(name);
    placeAcross();
}

void StepList::setStepVisible(int step, bool visible) {
    buttons_.at(std::size_t(step))->setVisible(visible);
    int number = 0;
    for (auto* button : buttons_)
        if (!button->isHidden()) button->setNumber(++number);
    placeAcross();
}

void StepList::setShown(int step) {
    shown_ = step;
    buttons_.at(std::size_t(step))->setChecked(true);
    placeAcross();
}

void StepList::focusShown() { buttons_.at(std::size_t(shown_))->setFocus(); }

void StepList::fit() {
    for (auto* button : buttons_) button->setLow(window()->height() < scaledPx(kRoomyWindow));
    placeAcross();
}

void StepList::setAcross(bool across) {
    if (std::exchange(across_, across) == across) return;
    layout_->setDirection(across ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    if (across) {
        layout_->addStretch();
    } else {
        delete layout_->takeAt(layout_->count() - 1);
        for (auto* button : buttons_) {
            button->setAcross(false, true);
            button->setMinimumWidth(0);
            button->setMaximumWidth(QWIDGETSIZE_MAX);
        }
    }
    setSizePolicy(QSizePolicy::Preferred, across ? QSizePolicy::Fixed : QSizePolicy::Preferred);
    placeAcross();
    updateGeometry();
}

bool StepList::named(std::size_t step, Names names) const {
    return names == Names::All || (names == Names::OfShown && int(step) == shown_);
}

int StepList::widthAcross(Names names) const {
    int width = 0;
    for (std::size_t i = 0; i < buttons_.size(); ++i) {
        if (!buttons_[i]->isHidden()) width += buttons_[i]->widthAcross(named(i, names));
    }
    return width;
}

void StepList::placeAcross() {
    if (!across_) return;
    const auto names = width() >= widthAcross(Names::All)       ? Names::All
                       : width() >= widthAcross(Names::OfShown) ? Names::OfShown
                                                                : Names::None;
    for (std::size_t i = 0; i < buttons_.size(); ++i) {
        buttons_[i]->setAcross(true, named(i, names));
        buttons_[i]->setFixedWidth(buttons_[i]->widthAcross(named(i, names)));
    }
    layout_->activate();
    updateGeometry();
}

QSize StepList::sizeHint() const {
    return across_ ? QSize(widthAcross(Names::All), QWidget::sizeHint().height()) : QWidget::sizeHint();
}

QSize StepList::minimumSizeHint() const {
    return across_ ? QSize(widthAcross(Names::None), QWidget::minimumSizeHint().height()) : QWidget::minimumSizeHint();
}

}  // namespace tacto::gui

#include "moc_StepList.cpp"
