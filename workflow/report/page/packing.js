structureCharts(pageData.tables);
new Player().load(pageData.movie, { label: pageData.label, note: '' });
recolour();
