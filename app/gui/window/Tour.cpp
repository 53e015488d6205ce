#include "app/gui/window/Tour.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"

namespace tacto::gui {

Tour::Tour(std::vector<TourStep> steps, QWidget* window) : QFrame(window), steps_(std::move(steps)) {
    setObjectName("tour");
    setAccessibleName(tr("Tour"));
    setFrameShape(QFrame::StyledPanel);
    setFrameShadow(QFrame::Raised);
    setAutoFillBackground(true);
    auto* layout = new QVBoxLayout(this);
    title_ = new QLabel(this);
    auto font = title_->font();
    font.setBold(true);
    font.setPointSizeF(font.pointSizeF() * 1.15);
    title_->setFont(font);
    layout->addWidget(title_);
    text_ = new QLabel(this);
    text_->setWordWrap(true);
    text_->setMinimumWidth(fontMetrics().averageCharWidth() * 46);
    layout->addWidget(text_);
    auto* row = new QHBoxLayout;
    place_ = new QLabel(this);
    place_->setForegroundRole(QPalette::PlaceholderText);
    row->addWidget(place_);
    row->addStretch();
    auto* skip = new QPushButton(tr("End &tour"), this);
    act_ = new QPushButton(this);
    next_ = new QPushButton(tr("&Next"), this);
    for (auto* button : {skip, act_, next_}) {
        button->setAutoDefault(false);
        row->addWidget(button);
    }
    layout->addLayout(row);
    connect(skip, &QPushButton::clicked, this, [this] {
        hide();
        emit ended();
    });
    connect(act_, &QPushButton::clicked, this, [this] {
        if (steps_[step_].act) steps_[step_].act();
    });
    connect(next_, &QPushButton::clicked, this, [this] {
        if (++step_ < steps_.size()) return showStep();
        hide();
        emit ended();
    });
    window->installEventFilter(this);
    hide();
}

void Tour::begin() {
    step_ = 0;
    showStep();
    show();
    raise();
    next_->setFocus();
}

void Tour::showStep() {
    const auto& step = steps_[step_];
    title_->setText(step.title);
    text_->setText(step.text);
    place_->setText(tr("%1 of %2").arg(step_ + 1).arg(steps_.size()));
    act_->setText(step.button);
    act_->setVisible(!step.button.isEmpty());
    next_->setText(step_ + 1 < steps_.size() ? tr("&Next") : tr("&Done"));
    place();
}

void Tour::place() {
    layout()->activate();
    adjustSize();
    const auto room = parentWidget()->rect();
    move(room.right() - width() - 24, room.bottom() - height() - 48);
}

bool Tour::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize && isVisible()) place();
    return QFrame::eventFilter(watched, event);
}

}  // namespace tacto::gui
