stateCharts(pageData);
new Player().load(pageData.movie, { label: pageData.label, note: '' });
byId('clock').hidden = true;  // a packing is at no time
recolour();
