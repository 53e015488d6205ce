#include "app/gui/scope/panels/ScopeStatus.h"

#include <QLabel>
#include <QToolButton>

#include "app/gui/scope/screen/LaneLegend.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

ScopeStatus::ScopeStatus(const ScopeModel& model, QWidget* parent)
    : QWidget(parent),
      text_(makeLabel({}, {.name = "scopeStatus", .size = TextSize::Small, .wraps = true}, this)),
      cancel_(new QToolButton(this)) {
    cancel_->setText(tr("Cancel"));
    cancel_->setToolTip(tr("Stops reading. The picture stays."));
    cancel_->setAutoRaise(true);
    cancel_->setFocusPolicy(Qt::StrongFocus);
    cancel_->hide();
    connect(cancel_, &QToolButton::clicked, this, &ScopeStatus::cancelClicked);
    auto* row = rowIn(*this, -1, {8, 0, 8, 0});
    row->addWidget(new LaneLegend(model, this), 0, Qt::AlignVCenter);
    row->addWidget(text_, 1);
    row->addWidget(cancel_);
}

void ScopeStatus::tell(const QString& done, const QString& problem) {
    done_ = done;
    problem_ = problem;
    told_.start();
}

void ScopeStatus::forget() {
    constexpr qint64 kMessageTimeout_ms = 8000;
    if (told_.isValid() && !told_.hasExpired(kMessageTimeout_ms)) return;
    done_.clear();
    problem_.clear();
}

void ScopeStatus::show(std::optional<int> percentRead, const QString& standing) {
    cancel_->setVisible(percentRead.has_value());
    text_->setText(!problem_.isEmpty() ? problem_
                   : percentRead       ? tr("Reading the capture, %1 %…").arg(*percentRead)
                   : !done_.isEmpty()  ? done_
                                       : standing);
}

}  // namespace tacto::gui

#include "moc_ScopeStatus.cpp"
