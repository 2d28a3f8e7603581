// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/KeysText.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Commands/Commands.h"
#include "Interaction/Commands/Tools.h"

#include <QStringList>

namespace brainshift
{
namespace
{
constexpr Scope Scopes[] = { Scope::Window, Scope::Tool, Scope::View, Scope::Slices, Scope::List };

// The tools that a row needs; empty where it needs none.
QString toolsText(const CommandRow& row)
{
  QStringList names;
  for (const Tool tool : row.tools)
  {
    names.append(nameOf(tool));
  }
  return names.join(", ");
}

QString htmlRow(const CommandRow& row)
{
  const QString tools = toolsText(row);
  const QString before = tools.isEmpty() ? QString() : QString("<i>%1</i>: ").arg(tools);
  return QString("<tr><td style=\"white-space:nowrap\"><b>%1</b>&nbsp;&nbsp;&nbsp;</td>"
                 "<td>%2%3</td></tr>")
    .arg(keysText(row).toHtmlEscaped(), before, tr(row.what).toHtmlEscaped());
}

QString markdownRow(const CommandRow& row)
{
  const QString tools = toolsText(row);
  return QString("| %1 | %2 | %3 |\n")
    .arg(keysText(row), tools.isEmpty() ? QString("any or none") : tools, QString(row.what));
}
}

QString keysAsHtml()
{
  QString text = "<table>";
  for (const Scope scope : Scopes)
  {
    text += QString("<tr><td colspan=2 style=\"padding-top:12px\"><big><b>%1</b></big></td></tr>")
              .arg(headingOf(scope).toHtmlEscaped());
    if (!remarkOn(scope).isEmpty())
    {
      text += QString("<tr><td colspan=2>%1</td></tr>").arg(remarkOn(scope).toHtmlEscaped());
    }
    for (const CommandRow& row : commandTable())
    {
      text += row.scope == scope ? htmlRow(row) : QString();
    }
  }
  return text + "</table>";
}

QString keysAsMarkdown()
{
  QStringList sections;
  for (const Scope scope : Scopes)
  {
    QString section = QString("## %1\n\n").arg(headingOf(scope));
    if (!remarkOn(scope).isEmpty())
    {
      section += remarkOn(scope) + "\n\n";
    }
    section += "| key or gesture | tool | what it does |\n|---|---|---|\n";
    for (const CommandRow& row : commandTable())
    {
      section += row.scope == scope ? markdownRow(row) : QString();
    }
    sections.append(section);
  }
  return "# Mouse and keys\n\n" + sections.join("\n");
}
}
