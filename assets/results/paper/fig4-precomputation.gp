# Draws fig4-precomputation.svg and fig4-precomputation.png: gnuplot fig4-precomputation.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'fig4-precomputation.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Fig. 4: precomputation'
set xlabel 'vertices'
set ylabel 'precomputation [s]'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
plot \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'fem' && strcol('part') eq 'precompute' ? column('vertices') : NaN)):(column('precompute_s')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'fem', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'constant-bem' && strcol('part') eq 'precompute' ? column('vertices') : NaN)):(column('precompute_s')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'constant-bem', \
  'paper.csv' using ((strcol('way') eq 'paper' && strcol('method') eq 'linear-bem' && strcol('part') eq 'precompute' ? column('vertices') : NaN)):(column('precompute_s')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'linear-bem'
unset output
reset
}
