function start() {
  structureCharts(pageData.tables);
  new SolidView().load(pageData.scene, pageData.label);
  recolour();
}

start();
