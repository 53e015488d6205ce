#include "app/gui/runner/WorstPage.h"

#include <QHeaderView>
#include <QPushButton>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/LimitSetView.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/TableContent.h"
#include "core/bench/arming/CommandPreview.h"
#include "core/electrode/Load.h"
namespace tacto::gui {

namespace {
constexpr int kMinChooser = 120;
constexpr int kMinRows = 2;
}  // namespace

WorstPage::WorstPage(QWidget* parent)
    : QWidget(parent),
      worst_(new ExposureTable(this)),
      says_(makeLabel({}, {.name = "worstCase", .wraps = true, .plain = true}, this)) {
    auto* column = columnIn(*this);
    column->addWidget(says_);
    column->addWidget(buildChooser());
    worst_->setAccessibleName(tr("Worst case against the limits"));
    worst_->setToolTip(
        tr("The strongest command into 80 to 120 % of the declared load, from an ideal voltage source. "
           "Hatched: not evaluated, and never a pass."));
    const auto least = [this] {
        worst_->setMinimumHeight(worst_->horizontalHeader()->sizeHint().height() + 2 * worst_->frameWidth() +
                                 kMinRows * worst_->verticalHeader()->defaultSectionSize());
    };
    least();
    afterLookChange(*worst_, least);
    column->addWidget(worst_, 1);
    setTabOrder(findChild<QPushButton*>("readLimits"), worst_);
}

/// Wrapped text may need more height than the layout's minimum: the surrounding page then scrolls.
bool WorstPage::event(QEvent* event) {
    const bool done = QWidget::event(event);
    if (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Resize)
        setMinimumHeight(leastHeightAt(*layout(), width()));
    return done;
}

QWidget* WorstPage::buildChooser() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder);
    chooser_ = new QComboBox(holder);
    nameWidget(*chooser_, "limitSetChooser", tr("Limit set"),
               tr("Selects the limit set to show. All limit sets always apply."));
    chooser_->addItem(tr("All limits"));
    const auto least = [this] { chooser_->setMinimumWidth(scaledPx(kMinChooser)); };  // its longest entry may be wider
    least();
    onFontChange(*chooser_, least);
    connect(chooser_, &QComboBox::currentIndexChanged, this, &WorstPage::filter);
    auto* read = pageButton(tr("Read the limits…"), "readLimits",
                            tr("Each limit with its value, the time it is taken over, and its source."), holder);
    connect(read, &QPushButton::clicked, this, [this] {
        if (sets_ != nullptr) openDialog(makeLimitSetWindow(*sets_, chooser_->currentData().toString(), window()));
    });
    addAll(*row, {chooser_, read});
    row->addStretch();
    return holder;
}

void WorstPage::show(std::vector<ExposureRow> rows) {
    rows_ = std::move(rows);
    filter();
}

void WorstPage::filter() {
    if (sets_ == nullptr) return;
    const auto chosen = chooser_->currentData().toString().toStdString();
    auto shown = rows_;
    std::erase_if(shown, [&](const ExposureRow& row) { return !chosen.empty() && row.set.view() != chosen; });
    worst_->show(shown, *sets_);
}

QString WorstPage::judge(const BenchController& controller, const Result<ProtocolSettings>& settings, bool drives) {
    if (std::exchange(sets_, &controller.limits().sets) == nullptr) {
        for (const auto& set : *sets_) chooser_->addItem(qtext(set.title), qtext(set.id));
    }
    if (!settings) {
        show({});
        says_->setText(tr("Shown again when every setting is accepted."));
        return {};
    }
    const auto load = declaredLoad(settings->parameters);
    const auto worst = worstCase(controller.profile(), controller.limits().sets, load);
    if (!worst) {
        show({});
        says_->setText("⚠ " + sentence(worst.error()));
        return {};
    }
    show(worst->rows);
    bool isNumber = false;
    const auto words = QString::fromStdString(load);
    const double ohms = words.section(' ', 0, 0).toDouble(&isNumber);
    const auto& encoding = controller.profile().encoding;
    const auto strongest =
        tr("The profile's strongest command, %1 every %2 into %3.")
            .arg(settingText(encoding.amplitudeMax.value(), "V"), settingText(encoding.intervalMin.count(), "s"),
                 isNumber && words.endsWith(" ohm") ? settingText(ohms, "ohm") : loadText(words));
    says_->setText(worst->refused.isEmpty() ? tr("%1 Nothing exceeds a limit that can be evaluated.").arg(strongest)
                                            : tr("⚠ %1 %2").arg(strongest, worst->refused));
    // A protocol without a load parameter is judged by its script, load by load.
    const bool judged = drives && settings->parameters.contains("load") && !worst->refused.isEmpty();
    return judged ? tr("%1 Choose another load or profile. The output stays off.").arg(worst->refused) : QString();
}

Result<WorstCase> worstCase(const Profile& profile, const std::vector<LimitSet>& limits, const std::string& load) {
    const auto parsed = parseLoad(load);
    if (!parsed) return failure(parsed);
    const Command strongest{profile.encoding.amplitudeMax, profile.encoding.intervalMin};
    auto preview = previewOf(strongest, profile, limits, *parsed);
    if (!preview) return failure(preview);
    WorstCase worst{std::move(preview->rows), {}};
    if (!preview->refusal) return worst;
    const auto* row = firstForbidding(worst.rows);
    worst.refused = row == nullptr
                        ? sentence(*preview->refusal)
                        : QObject::tr("%1 would be %2; %3 %4 is allowed (%5). Such a train will be refused.")
                              .arg(qtext(titleOf(row->quantity)), quantityText(row->value, qtext(row->unit), 3),
                                   row->strict ? QObject::tr("less than") : QObject::tr("at most"),
                                   settingText(row->limit, qtext(row->unit)), qtext(titleOf(limits, row->set.view())));
    return worst;
}

}  // namespace tacto::gui

#include "moc_WorstPage.cpp"
