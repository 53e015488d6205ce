#include "app/gui/theme/LimitSetView.h"

#include <QHeaderView>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

enum LimitColumn { kQuantityColumn, kLimitColumn, kOverColumn, kJudgedColumn, kEffectColumn, kSourceColumn };

QString limitOf(const LimitRow& row) {
    return QString("%1 %2").arg(row.strict ? "<" : "≤", settingText(row.max, qtext(unitOf(row.quantity))));
}

/// Replaces the plain ASCII units of the files by proper symbols.
QString shownUnits(std::string_view text) { return withOhmSigns(qtext(text)).replace("cm2", "cm²"); }

QString overText(const LimitRow& row) {
    const double window_s = windowOf(row.quantity);
    return window_s > 0 ? settingText(window_s, "s") : QObject::tr("one pulse");
}

QString judgedText(const LimitRow& row) {
    const auto where = row.judged == JudgedAt::Ohm500 ? QObject::tr("into 500 Ω") : QObject::tr("worst load");
    const auto from = settingText(row.aboveHz, "Hz"), to = settingText(row.upToHz, "Hz");
    if (row.aboveHz > 0 && row.upToHz > 0) return QObject::tr("%1, %2 to %3").arg(where, from, to);
    if (row.aboveHz > 0) return QObject::tr("%1, above %2").arg(where, from);
    return row.upToHz > 0 ? QObject::tr("%1, up to %2").arg(where, to) : where;
}

QString effectText(LimitAction action) {
    switch (action) {
        case LimitAction::Warn:
            return QObject::tr("warns");
        case LimitAction::Disclose:
            return QObject::tr("must be stated");
        case LimitAction::Refuse:
            break;
    }
    return QObject::tr("refuses");
}

}  // namespace

LimitSetView::LimitSetView(const std::vector<LimitSet>& sets, QWidget* parent)
    : QWidget(parent),
      sets_(sets),
      chooser_(new QComboBox(this)),
      table_(new QTableWidget(0, kSourceColumn + 1, this)),
      stated_(makeLabel({}, {.name = "limitDisclosures", .tone = Tone::Quiet, .wraps = true}, this)) {
    setObjectName("limitSetView");
    auto* column = new QVBoxLayout(this);
    auto* row = new QHBoxLayout;
    nameWidget(*chooser_, "limitSet", tr("Limit set"), tr("Selects the set to show. All sets always apply."));
    for (const auto& set : sets_) chooser_->addItem(qtext(set.title), qtext(set.id));
    row->addWidget(chooser_);
    row->addStretch();
    column->addLayout(row);
    nameWidget(*table_, "limitRows", tr("Limits of the set"));
    table_->setHorizontalHeaderLabels(
        {tr("Quantity"), tr("Limit"), tr("Over"), tr("Judged"), tr("Beyond it"), tr("Source")});
    table_->verticalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    makeReadOnly(*table_);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setWordWrap(true);
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    column->addWidget(table_, 1);
    column->addWidget(stated_);
    connect(chooser_, &QComboBox::currentIndexChanged, this, &LimitSetView::show);
    show(chooser_->currentIndex());
}

void LimitSetView::choose(const QString& id) {
    if (const int index = chooser_->findData(id); index >= 0) chooser_->setCurrentIndex(index);
}

void LimitSetView::show(int index) {
    if (index < 0 || index >= int(sets_.size())) return;
    const auto& set = sets_[std::size_t(index)];
    table_->setRowCount(int(set.rows.size()));
    for (int line = 0; line < table_->rowCount(); ++line) {
        const auto& limit = set.rows[std::size_t(line)];
        putText(*table_, line, kQuantityColumn, titled(qtext(titleOf(limit.quantity))), false);
        putText(*table_, line, kLimitColumn, limitOf(limit), true);
        putText(*table_, line, kOverColumn, overText(limit), true);
        putText(*table_, line, kJudgedColumn, judgedText(limit), false);
        putText(*table_, line, kEffectColumn, effectText(limit.action), false);
        putText(*table_, line, kSourceColumn, shownUnits(limit.source), false);
        auto tip =
            tr("%1 Confidence in this figure: %2.").arg(sentence(qtext(limit.source)), qtext(nameOf(limit.confidence)));
        if (!limit.note.empty()) tip += " " + sentence(qtext(limit.note));
        for (int column = 0; column < table_->columnCount(); ++column) table_->item(line, column)->setToolTip(tip);
    }
    for (int column = 0; column < kSourceColumn; ++column) table_->resizeColumnToContents(column);
    QStringList asked;
    for (const auto& one : set.accuracy) {
        const auto name = qtext(one.parameter);
        asked << (one.tolerance_pct > 0 ? tr("%1 within ± %2").arg(name, settingText(one.tolerance_pct, "%"))
                                        : tr("accuracy of the %1").arg(name));
    }
    for (const auto& one : set.disclosures) asked << shownUnits(one.output);
    stated_->setText(asked.isEmpty() ? tr("This limit set does not ask you to state an accuracy or an output.")
                                     : tr("The set also asks for: %1.").arg(asked.join("; ")));
}

QDialog* makeLimitSetWindow(const std::vector<LimitSet>& sets, const QString& id, QWidget* parent) {
    auto* dialog = new QDialog(parent);
    dialog->setWindowTitle(QObject::tr("Limits in force"));
    auto* column = new QVBoxLayout(dialog);
    auto* view = new LimitSetView(sets, dialog);
    view->choose(id);
    column->addWidget(view, 1);
    addCloseButton(*dialog, *column);
    const auto metrics = dialog->fontMetrics();
    dialog->resize(metrics.averageCharWidth() * 130, metrics.height() * 22);
    return dialog;
}

}  // namespace tacto::gui

#include "moc_LimitSetView.cpp"
