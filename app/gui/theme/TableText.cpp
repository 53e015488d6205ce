#include "app/gui/theme/TableText.h"

#include <QApplication>
#include <QCalendarWidget>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QRegularExpression>
#include <algorithm>
#include <functional>
#include <optional>
#include <set>

#include "app/gui/theme/Dialogs.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Told.h"
#include "core/base/QuantityText.h"
#include "core/base/WholeFile.h"

namespace tacto::gui {

namespace {

/// A cell that is a number, as NumberText.h writes it.
struct CellFigure {
    QString number;  ///< as a spreadsheet reads it
    QString unit;    ///< empty if the cell has none
};

bool isMissing(const QString& cell) { return cell.isEmpty() || cell == QStringLiteral("–"); }

std::optional<CellFigure> figureIn(const QString& cell) {
    static const QRegularExpression form(QStringLiteral(
        "\\A([-−]?[0-9]+(?:\u202f[0-9]{3})*(?:\\.[0-9]+)?)(?:\u202f([^0-9\\s\u202f±][^\\s\u202f]*))?\\z"));
    const auto found = form.match(cell);
    if (!found.hasMatch()) return std::nullopt;
    auto number = found.captured(1).remove(QChar(0x202f)).replace(QChar(0x2212), '-');
    return CellFigure{std::move(number), found.captured(2)};
}

/// Gives the numbers of one column the form that spreadsheets read, and their unit to the heading.
void settle(QString& heading, QStringList& cells) {
    std::vector<std::optional<CellFigure>> figures;
    bool any = false, all = true, zeros = true;  // zeros: no number is another
    for (const auto& cell : cells) {
        const auto& figure = figures.emplace_back(isMissing(cell) ? std::nullopt : figureIn(cell));
        all = all && (figure || isMissing(cell));
        any = any || figure;
        zeros = zeros && (!figure || figure->number.toDouble() == 0);
    }
    if (!any) return;
    std::set<QString> units, bases;
    QString largest;  // the unit with the largest prefix
    double factorOfLargest = 0;
    for (const auto& figure : figures) {
        if (!figure || (!zeros && figure->number.toDouble() == 0)) continue;  // a zero may have any prefix, or no unit
        units.insert(figure->unit);
        const auto parts = partsOfUnit(figure->unit.toStdString());
        bases.insert(qtext(parts.base));
        if (parts.factor > factorOfLargest) {
            factorOfLargest = parts.factor;
            largest = figure->unit;
        }
    }
    const bool one = all && units.size() == 1;
    const bool scaled = all && units.size() > 1 && bases.size() == 1 && !bases.begin()->isEmpty();
    const bool plain = units.empty() || (units.size() == 1 && units.begin()->isEmpty());
    const auto unit = one || scaled ? largest : QString();
    for (std::size_t i = 0; i < figures.size(); ++i) {
        auto& cell = cells[qsizetype(i)];
        const auto& figure = figures[i];
        if (!figure) {
            if (all) cell.clear();
        } else if (scaled) {
            const double factor = figure->unit.isEmpty() ? 1 : partsOfUnit(figure->unit.toStdString()).factor;
            cell = QString::number(figure->number.toDouble() * factor / factorOfLargest, 'g', 12);
        } else if (one || plain || figure->unit.isEmpty()) {
            cell = figure->number;
        }
    }
    if (!unit.isEmpty()) heading += QStringLiteral(" (%1)").arg(unit);
}

QString quotedCell(const QString& whole, QChar separator) {
    const auto cell = inertCell(whole);
    static constexpr QChar kSpecial[] = {QChar('"'), QChar('\n'), QChar('\r')};
    const bool special =
        cell.contains(separator) || std::ranges::any_of(kSpecial, [&](QChar each) { return cell.contains(each); });
    return special ? '"' + QString(cell).replace('"', QStringLiteral("\"\"")) + '"' : cell;
}

constexpr const char* kCopiedForm = "copiedAsTable";

/// Returns the widget with a form of facts that `watched` is or belongs to; null if there is none.
QWidget* formOf(QObject* watched) {
    if (!watched->isWidgetType()) return nullptr;
    for (auto* widget = static_cast<QWidget*>(watched); widget != nullptr && !widget->isWindow();
         widget = widget->parentWidget())
        if (widget->property(kCopiedForm).toBool()) return widget;
    return nullptr;
}

TableText textOfForm(const QWidget& holder) {
    const auto* form = qobject_cast<const QFormLayout*>(holder.layout());
    return form != nullptr ? textOf(*form) : TableText{};
}

QString selectedIn(const QObject* watched) {
    const auto* label = qobject_cast<const QLabel*>(watched);
    return label != nullptr ? label->selectedText() : QString();
}

/// Makes a menu for `owner`. The keys are the widget's own; the menu only shows them.
class CopyMenu {
public:
    explicit CopyMenu(QWidget& owner) : owner_(owner), menu_(new QMenu(&owner)) {
        menu_->setObjectName("tableMenu");
        menu_->setAttribute(Qt::WA_DeleteOnClose);
    }
    void add(const QString& text, QKeySequence::StandardKey key, std::function<void()> act) const {
        const auto keys = QKeySequence(key).toString(QKeySequence::NativeText);
        QObject::connect(menu_->addAction(keys.isEmpty() ? text : text + '\t' + keys), &QAction::triggered, &owner_,
                         std::move(act));
    }
    void popUp(const QContextMenuEvent& event, std::function<void()> save) const {
        menu_->addSeparator();
        add(QObject::tr("Save as CS&V…"), QKeySequence::UnknownKey, std::move(save));
        menu_->popup(event.globalPos());
    }

private:
    QWidget& owner_;
    QMenu* menu_;
};

/// Returns the table that an event goes to: by its viewport or a heading; null for other widgets and for calendars.
QTableView* tableOf(QObject* watched) {
    if (!watched->isWidgetType()) return nullptr;
    for (auto* widget = static_cast<QWidget*>(watched); widget != nullptr; widget = widget->parentWidget()) {
        if (auto* table = qobject_cast<QTableView*>(widget))
            return qobject_cast<QCalendarWidget*>(table->parentWidget()) == nullptr ? table : nullptr;
        const auto* area = qobject_cast<const QAbstractScrollArea*>(widget->parentWidget());
        const bool within = area != nullptr && area->viewport() == widget;
        if (!within && qobject_cast<const QHeaderView*>(widget) == nullptr) return nullptr;
    }
    return nullptr;
}

/// "Limits on each load" → "limits-on-each-load".
QString fileNameOf(const QWidget& table) {
    auto name = table.accessibleName().isEmpty() ? table.objectName() : table.accessibleName();
    static const QRegularExpression other("[^a-z0-9]+");
    name = name.toLower().replace(other, "-");
    while (name.startsWith('-')) name.remove(0, 1);
    while (name.endsWith('-')) name.chop(1);
    return name.isEmpty() ? QString("table") : name;
}

}  // namespace

TableText textOf(const QTableView& table, const QItemSelection* only) {
    TableText all;
    const auto* model = table.model();
    if (model == nullptr) return all;
    const int columns = model->columnCount(), rows = model->rowCount();
    all.rows.resize(std::size_t(rows));
    for (int column = 0; column < columns; ++column) {
        const auto said = model->headerData(column, Qt::Horizontal, kCopiedTextRole);
        auto heading = (said.isValid() ? said : model->headerData(column, Qt::Horizontal, Qt::DisplayRole))
                           .toString()
                           .simplified();
        QStringList cells;
        for (int row = 0; row < rows; ++row) {
            const auto at = model->index(row, column);
            const auto whole = at.data(kCopiedTextRole);
            cells << (whole.isValid() ? whole : at.data()).toString();
        }
        settle(heading, cells);
        all.head << heading;
        for (int row = 0; row < rows; ++row) all.rows[std::size_t(row)] << cells[row];
    }
    if (only == nullptr) return all;
    std::set<int> keptRows, keptColumns;
    std::set<std::pair<int, int>> chosen;
    for (const auto& index : only->indexes()) {
        keptRows.insert(index.row());
        keptColumns.insert(index.column());
        chosen.emplace(index.row(), index.column());
    }
    TableText kept;
    for (const int column : keptColumns) kept.head << all.head[column];
    for (const int row : keptRows) {
        auto& cells = kept.rows.emplace_back();
        for (const int column : keptColumns)
            cells << (chosen.contains({row, column}) ? all.rows[std::size_t(row)][column] : QString());
    }
    return kept;
}

TableText textOf(const QFormLayout& facts) {
    const auto labelAt = [&](int row, QFormLayout::ItemRole role) {
        const auto* item = facts.itemAt(row, role);
        const auto* label = item != nullptr ? qobject_cast<const QLabel*>(item->widget()) : nullptr;
        return label != nullptr ? label->text() : QString();
    };
    TableText all{{QObject::tr("Name"), QObject::tr("Value")}, {}};
    for (int row = 0; row < facts.rowCount(); ++row) {
        auto name = labelAt(row, QFormLayout::LabelRole).simplified();
        QStringList value{labelAt(row, QFormLayout::FieldRole)};
        settle(name, value);
        all.rows.push_back({name, value.front()});
    }
    return all;
}

void copyAsTable(QWidget& holder) { holder.setProperty(kCopiedForm, true); }

QString inertCell(const QString& cell) {
    const auto first = cell.isEmpty() ? QChar() : cell.front();
    bool number = false;
    if (first == '+' || first == '-') static_cast<void>(cell.toDouble(&number));
    return !number && !first.isNull() && QStringLiteral("=+-@\t\r\n").contains(first) ? '\'' + cell : cell;
}

QString separated(const TableText& table, QChar separator) {
    QString text;
    const auto add = [&](const QStringList& cells) {
        QStringList quoted;
        for (const auto& cell : cells) quoted << quotedCell(cell, separator);
        // A line without any character would be read as no row.
        text += (cells.size() == 1 && cells.front().isEmpty() ? QStringLiteral("\"\"") : quoted.join(separator)) + '\n';
    };
    add(table.head);
    for (const auto& row : table.rows) add(row);
    return text;
}

void TableCopies::install() {
    static TableCopies* copies = nullptr;
    if (copies != nullptr) return;
    copies = new TableCopies(qApp);
    connect(copies, &QObject::destroyed, [] { copies = nullptr; });
    qApp->installEventFilter(copies);
}

void TableCopies::copy(const QTableView& table) {
    if (table.model() == nullptr) return;
    const auto selection = table.selectionModel()->selection();
    const auto chosen = textOf(table, selection.isEmpty() ? nullptr : &selection);
    const bool single = chosen.rows.size() == 1 && chosen.head.size() == 1 && table.model()->columnCount() > 1;
    if (single) {
        const auto at = selection.indexes().front();
        const auto whole = at.data(kCopiedTextRole);
        return QApplication::clipboard()->setText((whole.isValid() ? whole : at.data()).toString());
    }
    QApplication::clipboard()->setText(separated(chosen, '\t'));
}

void TableCopies::askSave(QWidget& asking, const TableText& table) {
    const FileQuestion question{.title = tr("Save the table as CSV"),
                                .wants = FileQuestion::Wants::NewFile,
                                .filters = {tr("Tables (*.csv)")},
                                .name = fileNameOf(asking) + ".csv",
                                .suffix = "csv"};
    askForFile(asking, question, [&asking, text = separated(table, ',')](const QString& path) {
        const auto written = writeWholeFile(path.toStdString(), text.toStdString());
        if (written) return tell(tr("The table is saved to %1.").arg(path));
        openDialog(new QMessageBox(QMessageBox::Warning, tr("Not saved"),
                                   tr("%1 was not saved: %2. An existing file of that name was not changed.")
                                       .arg(path, qtext(written.error().message)),
                                   QMessageBox::Ok, &asking));
    });
}

bool TableCopies::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Polish) {
        auto* table = qobject_cast<QTableView*>(watched);
        const auto one = QAbstractItemView::SingleSelection, none = QAbstractItemView::NoSelection;
        if (table == nullptr || tableOf(table) == nullptr) return false;
        if (table->selectionMode() == one || table->selectionMode() == none)
            table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    } else if (event->type() == QEvent::KeyPress) {
        if (!static_cast<QKeyEvent*>(event)->matches(QKeySequence::Copy)) return false;
        if (const auto* table = qobject_cast<QTableView*>(watched); table != nullptr && tableOf(watched) != nullptr) {
            copy(*table);
            return true;
        }
        const auto* form = formOf(watched);
        if (form == nullptr || !selectedIn(watched).isEmpty()) return false;
        QApplication::clipboard()->setText(separated(textOfForm(*form), '\t'));
        return true;
    } else if (event->type() == QEvent::ContextMenu) {
        const auto& asked = *static_cast<QContextMenuEvent*>(event);
        if (auto* table = tableOf(watched); table != nullptr) {
            if (table->contextMenuPolicy() == Qt::NoContextMenu) return false;
            const CopyMenu menu(*table);
            menu.add(tr("&Copy"), QKeySequence::Copy, [table] { copy(*table); });
            menu.add(tr("Select &all"), QKeySequence::SelectAll, [table] { table->selectAll(); });
            menu.popUp(asked, [table] { askSave(*table, textOf(*table)); });
            return true;
        }
        auto* form = formOf(watched);
        if (form == nullptr) return false;
        const CopyMenu menu(*form);
        const auto put = [](const QString& text) { return [text] { QApplication::clipboard()->setText(text); }; };
        if (const auto chosen = selectedIn(watched); !chosen.isEmpty())
            menu.add(tr("Copy the selected &text"), QKeySequence::Copy, put(chosen));
        menu.add(tr("&Copy as a table"), QKeySequence::UnknownKey, put(separated(textOfForm(*form), '\t')));
        menu.popUp(asked, [form] { askSave(*form, textOfForm(*form)); });
        return true;
    }
    return false;
}

}  // namespace tacto::gui

#include "moc_TableText.cpp"
